"""The folder of a run of any study, opened: its kind, declared columns, snapshots and numbers. Of made-up folders;
needs no YADE.
"""

import json

import numpy as np
import pytest

import synthetic_slope as synthetic

runs, records = synthetic.load("studies.runs"), synthetic.load("records")
biaxial_test, tension_test, wall_shear, heap_columns, sphere_columns = (
    synthetic.load(f"studies.{name}")
    for name in (
        "laboratory.biaxial_test",
        "laboratory.tension_test",
        "laboratory.wall_shear",
        "heaps.columns",
        "spheres.columns",
    )
)
STUDIES = [
    ("biaxial test", biaxial_test.COLUMNS, runs.BiaxialRun),
    ("tension test", tension_test.COLUMNS, runs.TensionRun),
    ("slide", wall_shear.COLUMNS, runs.SlideRun),
    ("heap", heap_columns.COLUMNS, runs.HeapRun),
    ("spheres", sphere_columns.COMMON | sphere_columns.COLUMN, runs.SpheresRun),
    ("spheres", sphere_columns.COMMON | sphere_columns.HOPPER, runs.SpheresRun),
    ("spheres", sphere_columns.COMMON | sphere_columns.DRUM, runs.SpheresRun),
    ("spheres", sphere_columns.COMMON | sphere_columns.PILE, runs.SpheresRun),
    ("spheres", sphere_columns.COMMON | sphere_columns.TRIAXIAL, runs.SpheresRun),
]


def written(folder, columns):
    with records.SeriesWriter(folder / "series.csv", columns) as series:
        for step in range(1, 4):
            series.write({name: step for name in columns})
    return folder


@pytest.mark.parametrize("kind, columns, made", STUDIES)
def test_the_columns_of_a_series_tell_what_was_run(kind, columns, made, tmp_path):
    run = runs.open_run(written(tmp_path, columns))
    assert (type(run), run.kind, run.columns) == (made, kind, columns)
    for name, values in run.series.items():
        assert values.dtype == (np.int64 if columns[name].integer else np.float64), name
    with pytest.raises(runs.RunError, match="result.json: missing"):
        run.summary
    (tmp_path / "result.json").write_text(json.dumps({"key": "", "found": {"steps": 3}}))
    assert runs.open_run(tmp_path).summary == {"steps": 3}
    with pytest.raises(runs.RunError, match="breaks.csv: missing"):
        run.breaks


def test_the_folder_of_a_study_names_its_runs_and_one_that_is_not_there_is_told(tmp_path):
    for name in ("seed1", "seed2"):
        folder = tmp_path / "runs" / name
        folder.mkdir(parents=True)
        written(folder, heap_columns.COLUMNS)
    with pytest.raises(runs.RunError, match="holds the runs of a study .* open one of them, .*seed1, … seed2"):
        runs.open_run(tmp_path)
    with pytest.raises(runs.RunError, match="there is no such folder"):
        runs.open_run(tmp_path / "nowhere")


def test_a_run_of_spheres_knows_its_scene_and_its_world(tmp_path):
    run = runs.open_run(written(tmp_path, sphere_columns.COMMON | sphere_columns.PILE))
    asked = {"kind": "column", "scene": {"aspect": 0.5, "size": 5.0}, "world": {"name": "soft", "stiffness": 1e5}}
    (tmp_path / "request.json").write_text(json.dumps({"arguments": asked}))
    assert (run.scene.aspect, run.scene.size) == (0.5, 5.0) and run.world["name"] == "soft"


def test_a_series_without_the_solvers_columns_is_still_of_its_study(tmp_path):
    soft = records.columns.without(biaxial_test.COLUMNS, biaxial_test.OF_SOLVER)
    run = runs.open_run(written(tmp_path, soft))
    assert run.kind == "biaxial test" and list(run.columns) == list(soft)


def test_snapshots_are_found_by_name_and_by_time(tmp_path):
    run = runs.open_run(written(tmp_path, biaxial_test.COLUMNS))
    with pytest.raises(runs.RunError, match="snapshot 'end': give a time .*none: the run has written no snapshot yet"):
        run.snapshot("end")
    with pytest.raises(runs.RunError, match="has written no snapshot yet"):
        run.snapshot(1.0)
    for k, name in enumerate(("begin", "1", "end")):
        disks = dict(x=[float(k)], y=[0.0], r=[1.0])
        records.write_snapshot(tmp_path / "snapshots" / f"{name}.npz", time_s=2.0 * k, step=k, **disks)
    assert set(run.snapshots) == {"begin", "1", "end"}
    assert [run.snapshot(asked).step for asked in ("begin", "1", 2.9, 3.1, 99)] == [0, 1, 1, 2, 2]
    with pytest.raises(runs.RunError, match="snapshot '2': give a time .s., or one of 1, begin, end"):
        run.snapshot("2")


def test_a_folder_of_no_study_is_refused(tmp_path):
    with pytest.raises(runs.RunError, match="no section.yaml, and no series.csv with the columns of another study"):
        runs.open_run(tmp_path)
    written(tmp_path, ("step", "time_s", "of_my_own"))
    with pytest.raises(runs.RunError, match="give the folder that was given to --out"):
        runs.open_run(tmp_path)


def test_names_of_before_are_the_same_classes():
    assert runs.Run is runs.SlopeRun and runs.RunError is runs.RunFolderError
