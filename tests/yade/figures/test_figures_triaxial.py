"""Figures of triaxial tests, read from their artists. Needs no YADE."""
import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

triaxial, laws, records, columns = (
    synthetic.load(name) for name in ("figures.triaxial", "measure.sphere_laws", "records", "studies.spheres.columns")
)


def run(friction, share=1.0, world="hard"):
    return {"scene": {"friction": friction, "friction_share": share, "pressure": 1e5}, "world": world}


def series(ratio):
    found = {name: np.full(3, 1e5) for name in columns.TRIAXIAL}
    found |= {"strain": np.array([0.01, 0.02, 0.03]), "volumetric_strain": np.array([0.0, -0.01, 0.02])}
    return found | {name: np.full(3, ratio * 1e5) for name in ("sigma_top_Pa", "sigma_bottom_Pa")}


def test_curves_show_the_deviator_over_the_mean_stress_and_the_volume():
    """σ₁ = 2 σ₃: q/p = 1/(4/3)."""
    runs = {"a": run(0.1), "b": run(0.1), "c": run(0.3)}
    top, bottom = triaxial.curves({name: series(2.0) for name in runs}, {"runs": runs}).axes
    assert [t.get_text() for t in top.get_legend().get_texts()] == ["μ 0.1", "μ 0.3"]  # a case, not each run
    assert drawn.points(drawn.line(top, "μ 0.3")) == pytest.approx(np.array([[1, 0.75], [2, 0.75], [3, 0.75]]))
    assert drawn.points(bottom.lines[0]) == pytest.approx(np.array([[1, 0], [2, -1], [3, 2]]))
    with pytest.raises(records.RecordsError, match="no triaxial tests"):
        triaxial.curves({}, {"runs": {}})


def group(friction, critical, share=1.0, world="hard"):
    def of(mean):
        return {"mean": mean, "half_width": 0.5}

    return {
        "world": world, "asked": {"friction": friction, "friction_share": share}, "critical_deg": of(critical),
        "peak_deg": of(critical + 5), "isotropic_solid_fraction": of(0.6), "isotropic_coordination": of(5.0),
    }  # fmt: skip


def test_angles_stand_against_friction_with_what_is_published():
    groups = [group(0.5, 22.0), group(0.1, 15.0), group(0.5, 23.0, share=0.0)]
    left, upper, lower = triaxial.angles(groups).axes
    bars = {one.get_label(): drawn.points(one.lines[0]).tolist() for one in left.containers}
    assert bars["critical state, loose"] == [[0.1, 15], [0.5, 22]] and bars["peak, loose"] == [[0.1, 20], [0.5, 27]]
    assert bars["critical state, dense"] == [[0.5, 23]]
    # against the friction that they were pressed with
    assert {one.get_label(): drawn.points(one.lines[0])[:, 0].tolist() for one in upper.containers} == {
        "loose": [0.1, 0.5], "dense": [0.0],
    }  # fmt: skip
    published = drawn.points(drawn.line(lower, laws.ISOTROPIC.source))
    assert published == pytest.approx(np.array([[0, 6], [0.3, 4.5]]))
    assert any("Gong" in t.get_text() for t in left.get_legend().get_texts())
    with pytest.raises(records.RecordsError, match="no triaxial tests"):
        triaxial.angles([])
