"""How commands end: one line on a line of its own and a status of 1 for what a user can mend, 130 after Ctrl-C; nothing
half-written; one run at a time in a folder.
"""

import ast
import json
import re
import resource
import signal
import subprocess
import warnings
from pathlib import Path

import leftovers
import pytest
import shell
import slope_scenes
from contact_scenes import material
from shell import SCRIPTS, ended, start
from yade import O
from yade.nonsmooth import commands, errors, records, scene
from yade.nonsmooth.laboratory import calibration, campaign, materials
from yade.nonsmooth.records import checkpoints
from yade.nonsmooth.running import interrupts, side_by_side
from yade.nonsmooth.studies.slope import results, run_files
from yade.nonsmooth.system import keys, output_folder, whole_files
from yade.nonsmooth.world import stepping
from yade.wrapper import NonsmoothTimeStepper

ENVIRONMENT = shell.environment()
SLOPE = ("--disks", "300", "--threads", "1", "--seed", "1")


@pytest.fixture(scope="module")
def section(tmp_path_factory):
    return slope_scenes.write_quick(tmp_path_factory.mktemp("section"))


# ---- steps ----------------------------------------------------------------------------------------


def test_a_refused_step_ends_a_command_with_the_engines_words():
    O.reset()
    O.step()
    O.engines = [NonsmoothTimeStepper()]
    with pytest.raises(
        stepping.StepError, match="^step 1: NonsmoothTimeStepper: O.engines has no ContactDynamicsEngine"
    ):
        stepping.advance(5)
    assert O.iter == 1 and issubclass(stepping.StepError, errors.UserError)


def test_no_step_is_none():
    O.reset()
    stepping.advance(0)  # O.run(0, True) would never end
    assert O.iter == 0
    stepping.advance(3)
    assert O.iter == 3


def test_a_scene_is_followed_until_it_is_calm_or_its_steps_are_used_up():
    made = []
    assert stepping.until(lambda: sum(made) >= 30, 100, 10, made.append) and made == [10, 10, 10]
    made.clear()
    # the last chunk begins within the limit
    assert not stepping.until(lambda: False, 25, 10, made.append) and made == [10, 10, 10]
    made.clear()
    assert stepping.until(lambda: True, 5, make=made.append) and made == [1]


def test_the_library_makes_no_steps_in_a_thread_that_swallows_refusals():
    package = Path(stepping.__file__).resolve().parents[1]
    found = [
        path.name
        for path in package.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "O.run"
    ]
    assert found == []


# ---- disks that are full, folders that cannot be written ------------------------------------------


def test_a_limit_on_files_is_one_line_and_nothing_is_half_written(section, tmp_path, tmp_path_factory):
    """As a full disk: the first checkpoint is larger. The bar is shown by then; its line ends before the message."""
    history = {"IPYTHONDIR": str(tmp_path_factory.mktemp("history"))}  # of YADE's prompt, whose file may be larger too
    process = start(
        "jiufengershan.py", "--section", section, *SLOPE, "--end", "2.2", "--out", tmp_path, limit=200_000, **history
    )
    status, _, lines = ended(process)
    assert status == 1 and lines[-1] == "" and lines[-2].startswith("error: ") and str(tmp_path) in lines[-2], lines
    assert sum("error: " in line for line in lines) == 1
    assert not list(tmp_path.rglob(".part-*")) and not list(tmp_path.rglob("scene-*"))


def test_a_full_disk_is_one_line(section, tmp_path):
    command = f"mount -t tmpfs -o size=120k none {tmp_path} && {SCRIPTS}/jiufengershan.py --section {section} --out {tmp_path} {' '.join(SLOPE)} --end 2.2"
    if subprocess.run(["unshare", "-m", "mount", "-t", "tmpfs", "none", tmp_path], capture_output=True).returncode:
        pytest.skip("mounting wants a root user who may")
    process = subprocess.Popen(
        ["unshare", "-m", "sh", "-c", command],
        env=ENVIRONMENT,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    status, _, lines = ended(process)
    assert status == 1 and lines[-2].startswith("error: ") and "No space left on device" in lines[-2], lines


@pytest.mark.parametrize("missing", [1, 4000])
def test_the_end_of_a_scene_that_is_cut_off_is_noticed(tmp_path, missing):
    """YADE says nothing where the last bytes of a file do not fit."""
    O.reset()
    stuff = material()
    O.bodies.append([scene.disk((2 * k, 0), 0.5, stuff) for k in range(20)])
    checkpoints.write(tmp_path, "key", {"old": 1})
    size = json.loads((tmp_path / "checkpoint" / "checkpoint.json").read_text())["size"]
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size - missing, before[1]))
    try:
        with pytest.raises(whole_files.WriteError, match="the checkpoint cannot be written"):
            checkpoints.write(tmp_path, "key", {"new": 1})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert (
        checkpoints.read(tmp_path, "key", errors.UserError) == {"old": 1}
        and len(list((tmp_path / "checkpoint").iterdir())) == 2
    )


def test_nan_is_not_written_into_a_checkpoint(tmp_path):
    O.reset()
    with pytest.raises(ValueError):
        checkpoints.write(tmp_path, "key", {"state": float("nan")})
    assert not checkpoints.exists(tmp_path)


def test_a_figure_is_whole_or_not_there(tmp_path):
    from matplotlib.figure import Figure
    from yade.nonsmooth.figures import style

    class Broken(Figure):
        def savefig(self, path, **options):
            Path(path).write_bytes(b"half")
            raise OSError(28, "No space left on device")

    (tmp_path / "a.png").write_bytes(b"old")
    with pytest.raises(records.RecordsError, match="a.png.*No space left"):
        style.save(Broken(), tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == b"old" and len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize(
    "raised, status, said",
    [
        (errors.UserError("no such rock"), 1, "error: no such rock\n"),
        (
            OSError(28, "No space left on device", "x.png"),
            1,
            "error: x.png: cannot be used (No space left on device); ",
        ),
        (KeyboardInterrupt(), 130, "stopped: parts are kept\n"),
        (interrupts.Interrupted("at 3 s"), 130, "stopped: at 3 s\n"),
    ],
)
def test_a_command_ends_with_its_status_and_one_line(capsys, raised, status, said):
    def main():
        raise raised

    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(SystemExit) as end:
        commands.run(main, "parts are kept")
    signal.signal(signal.SIGINT, before)
    told = capsys.readouterr().err
    assert end.value.code == status and told.startswith(said) and told.count("\n") == 1


def test_an_error_of_ours_keeps_its_traceback():
    with pytest.raises(FileNotFoundError):
        commands.run(lambda: open("/nowhere/at/all"))
    with pytest.raises(ZeroDivisionError):
        commands.run(lambda: 1 / 0)


def test_an_old_name_is_told_in_one_line(in_process, tmp_path):
    def change(data):
        del data["water"]["pressure_gradient"]
        data["water"]["gradient"] = "buoyant"

    old = slope_scenes.write_changed(tmp_path, change)
    done = in_process("sweep.py", "--section", old, "--over", "seed=1,2", "--plan", "--out", tmp_path / "out")
    assert done.status == 0 and re.fullmatch(
        rf"warning: {old}: line \d+: water\.gradient: .*; write `pressure_gradient: parallel_seepage`\n", done.err
    )


def test_a_note_is_one_line(capsys):
    """Other warnings are left to Python, which says where they come from."""
    commands.run(lambda: warnings.warn("a file is damaged; it is made anew", errors.UserNote))
    assert capsys.readouterr().err == "warning: a file is damaged; it is made anew\n"
    with pytest.warns(RuntimeWarning, match="^ours$"):
        commands.run(lambda: warnings.warn("ours", RuntimeWarning))
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("leave", [True, False])
def test_a_message_begins_a_line_after_a_bar(capfd, leave):
    import sys

    from tqdm import tqdm

    before = signal.getsignal(signal.SIGINT)

    def main():
        with commands.closing(tqdm(total=10, leave=leave, file=sys.stderr)) as bar:
            bar.update(3)
            raise errors.UserError("no such rock")

    with pytest.raises(SystemExit):
        commands.run(main)
    signal.signal(signal.SIGINT, before)
    assert capfd.readouterr().err.split("\n")[-2:] == ["error: no such rock", ""]


# ---- folders --------------------------------------------------------------------------------------


def test_two_runs_do_not_write_into_one_folder(tmp_path):
    output_folder.claim(tmp_path, "jiufengershan.py")
    output_folder.claim(tmp_path, "jiufengershan.py")  # this process has it already
    status, _, lines = ended(start("jiufengershan.py", *SLOPE, "--out", tmp_path))
    assert status == 1 and lines[-2].startswith(f"error: {tmp_path}: another run is writing into this folder")
    assert sorted(path.name for path in tmp_path.iterdir()) == [output_folder.LOCK]


def test_a_folder_is_free_once_its_run_is_dead(tmp_path):
    code = f"from yade.nonsmooth.system import output_folder; output_folder.claim({str(tmp_path)!r}, 'a.py'); import os; os.kill(os.getpid(), 9)"
    script = tmp_path / "claims.py"
    script.write_text(code)
    assert subprocess.run([SCRIPTS / "yade-nonsmooth", script], env=ENVIRONMENT, capture_output=True).returncode == -9
    output_folder.claim(tmp_path, "b.py")
    assert (tmp_path / output_folder.LOCK).read_text() == "a.py\nb.py\n"


@pytest.mark.parametrize(
    "words, seen, threads",
    [
        (("--threads", "1", "SCRIPT", "a", "b"), ["a", "b"], 1),
        (("--threads=2", "SCRIPT", "--threads", "7"), ["--threads", "7"], 2),  # the script's own
        (("SCRIPT", "--threads", "2", "c"), ["--threads", "2", "c"], 2),
    ],
)
def test_threads_before_the_script_are_the_launchers_alone(words, seen, threads, tmp_path):
    script = tmp_path / "words.py"
    script.write_text("import sys\nfrom yade import O\nprint('seen', sys.argv[1:], O.numThreads)\n")
    words = [str(script) if word == "SCRIPT" else word for word in words]
    done = subprocess.run([SCRIPTS / "yade-nonsmooth", *words], env=ENVIRONMENT, capture_output=True, text=True)
    assert done.returncode == 0 and f"seen {seen} {threads}\n" in done.stdout, done.stdout + done.stderr


def test_a_resume_in_the_folder_of_another_command_is_refused(tmp_path):
    output_folder.claim(tmp_path, "column.py")
    with pytest.raises(output_folder.FolderError, match="holds what column.py wrote, nothing of biaxial.py"):
        output_folder.claim(tmp_path, "biaxial.py", resume=True)
    assert (tmp_path / output_folder.LOCK).read_text() == "column.py\n"
    output_folder.claim(tmp_path, "biaxial.py")
    output_folder.claim(tmp_path, "biaxial.py", resume=True)
    output_folder.claim(tmp_path / "new", "biaxial.py", resume=True)  # nothing there yet: it begins


def test_an_old_run_is_taken_away_with_its_result_first(tmp_path, monkeypatch):
    """Killed while the old folder is removed, nothing is left that a resume would take."""
    for name in ("result.json", "series.csv", "checkpoint/checkpoint.json"):
        (tmp_path / "a" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "a" / name).write_text("{}")

    def killed(folder, *spared):
        raise KeyboardInterrupt

    monkeypatch.setattr(side_by_side, "empty", killed)
    with pytest.raises(KeyboardInterrupt):
        side_by_side.run([side_by_side.Run("a", tmp_path / "a", print, {}, "key")], 1)
    left = sorted(path.name for path in (tmp_path / "a").rglob("*") if path.is_file())
    assert (
        left == ["key", "series.csv"] and (tmp_path / "a" / "key").read_text() == ""
    )  # the mark that runs may empty it


def test_a_fresh_run_takes_all_records_of_the_old_one_away_and_nothing_else(tmp_path):
    old = (
        run_files.SUMMARY,
        run_files.BREAKS,
        run_files.BEGIN,
        run_files.END,
        *run_files.FIGURES,
        "snapshots/00000100.npz",
        "vtk/disks-00000100.vtu",
        "vtk/avalanche.pvd",
        "snapshots/.part-01-00000150.npz",
        ".part-02-end.npz",
    )
    own = ("notes.txt", "snapshots/notes.txt", "other.png", "vtk/view.pvsm")
    for name in (*old, *own):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    run_files.forget(tmp_path)
    assert sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()) == sorted(
        own
    )


def test_half_written_files_are_no_snapshots(tmp_path):
    leftovers.plant(tmp_path, "00000100.npz")
    (tmp_path / "00000100.npz").write_text("")
    (tmp_path / "00000050.npz").write_text("")
    assert [path.name for path in whole_files.whole(tmp_path, "*.npz")] == ["00000050.npz", "00000100.npz"]


def test_nothing_lists_files_but_asks_for_whole_ones():
    """Lists of folders' contents stand in whole_files.py, and where no run writes: shipped sections, the processor's
    caches, this package and the engines.
    """
    package = Path(whole_files.__file__).resolve().parents[1]
    lists = [
        path.name
        for path in sorted([*package.rglob("*.py"), *SCRIPTS.rglob("*.py")])
        for _ in re.findall(r"\.r?glob\(|\.iterdir\(|listdir\(|scandir\(|os\.walk\(", path.read_text())
    ]
    assert sorted(lists) == [
        "folder.py",
        "installation.py",
        *["keys.py"] * 2,  # this package
        "machine.py",
        "scripts.py",  # the lessons that there are
        *["whole_files.py"] * 4,
        "yade_examples.py",  # YADE's sources
    ]


def test_what_killed_processes_left_half_written_goes_with_the_claim(tmp_path):
    names = [
        f"{home}{name}"
        for home in ("", "figures/", "runs/a/", "runs/a/snapshots/", "tests/b/vtk/")
        for name in ("summary.json", "00000100.npz")
    ]
    others = ["runs/held/00000100.npz", "runs/held/snapshots/00000100.npz", ".cache/packings/a.npz"]
    leftovers.plant(tmp_path, *names, *others)
    for name in names:
        (tmp_path / name).write_text("whole")
    # another command's, which may be running
    (tmp_path / "runs" / "held" / output_folder.LOCK).write_text("column.py\n")
    output_folder.claim(tmp_path, "compare_hard_soft.py", resume=True)
    assert [Path(name).parent.as_posix() for name in leftovers.found(tmp_path)] == [
        Path(name).parent.as_posix() for name in sorted([*others, *others])
    ]
    assert all((tmp_path / name).read_text() == "whole" for name in names)
    output_folder.claim(tmp_path / "runs" / "held", "column.py", resume=True)
    assert len(leftovers.found(tmp_path)) == 2  # those of the hidden folder


def test_a_folder_that_another_process_holds_keeps_what_it_is_writing(tmp_path):
    output_folder.claim(tmp_path, "jiufengershan.py")
    leftovers.plant(tmp_path, "summary.json")  # by this process
    status, _, lines = ended(start("column.py", "--aspect", 1, "--disks", 60, "--out", tmp_path))
    assert (
        status == 1 and "another run is writing into this folder" in lines[-2] and len(leftovers.found(tmp_path)) == 2
    )


def test_a_series_without_rows_is_one_message(tmp_path, section):
    from yade.nonsmooth import section as sections

    (tmp_path / "series.csv").write_text("step,time_s\n")
    with pytest.raises(records.RecordsError, match="has no rows yet"):
        results.summarise(tmp_path, sections.load(str(section)), {})


@pytest.mark.parametrize(
    "content", ["", "[", "{}x", "3", '[{"key": 1}]', '[{"key": "a", "found": ["x"]}]', "[" * 100_000]
)
def test_damaged_trials_of_a_search_are_one_message(tmp_path, content):
    (tmp_path / "trials.json").write_text(content)
    with pytest.raises(campaign.CampaignError, match="trials.json.*remove the file"):
        calibration.Calibration(calibration.Wanted(50e3, 30.0), materials.load("wwr"), tmp_path, 1, resume=True)


def test_a_wedge_that_ended_early_is_not_taken(tmp_path):
    table = "seconds friction water save\n2.0 0.6 0 'dry_hard.part'\n"
    source = (SCRIPTS / "examples" / "hard_wedge.py").read_text()
    (tmp_path / "dry_hard.key").write_text(keys.run_key([table, source]))
    (tmp_path / "dry_hard.txt").write_text("# t centroid largest\n0.1 0.0 0.0\n0.2 0.0 0.0\n")
    status, _, lines = ended(start("wedge.py", "--seconds", 2, "--resume", "--out", tmp_path))
    assert status == 1 and "dry_hard.txt: the run ended before 2 s" in lines[-2], lines
