"""The bits of three scenes: SHA-256 of the first 200 rows of a slope, of a biaxial test and of a column, without the
wall time.

They are the same on Debian 12 and 13, with any processor and any number of threads. A commit that changes one says in
its message that bits change, and why; a rebuilding changes none. To see what changed, lay the series of both commits
side by side: the folder is in the failure's message.
"""
import hashlib
from dataclasses import asdict

import pytest
from yade.nonsmooth import experiment, section
from yade.nonsmooth.heaps import column, study
from yade.nonsmooth.laboratory import biaxial, materials, pressing

from slope_scenes import write_quick

ROWS = 200
PINNED = {
    "slope": "1d425958fa6a026218237d219af18b51f1aa0a97cfcf3b5f00565bd719f8d347",
    "biaxial": "46e9e9042900c4de65d2c58789c8e1d3d32c427c5f472191f47e4d383a708d39",
    "column": "215126531ffbbe444eedfc466c76a76dd48e8ab220dfb85ed297fd5ade5d0831",
}


pytestmark = pytest.mark.usefixtures("empty")


def first_rows(path):
    """SHA-256 of the header and the first rows of a series, and how many rows these are; ``wall_s`` is left out."""
    header, *rows = (line.split(",") for line in path.read_text().splitlines()[: 1 + ROWS])
    kept = [k for k, name in enumerate(header) if name != "wall_s"]
    text = "\n".join(",".join(row[k] for k in kept) for row in [header, *rows])
    return hashlib.sha256(text.encode()).hexdigest(), len(rows)


def slope_series(folder):
    """Gravity grows, the slope rests, the water rises; weak disks on the plane, so that bonds break and disks get
    going.
    """
    s = section.load(str(write_quick(folder))).with_disks(300)
    experiment.begin(s, folder).run(end=0.1 * ROWS + 0.05)
    return folder / "series.csv"


def biaxial_series(folder):
    shape = pressing.Shape(count=150, seed=3, d_min=1.0, d_max=2.0, fraction=0.82, friction=0.0)
    test = biaxial.BiaxialTest(
        materials.load("wwr"),
        1e6,
        shape,
        strain=biaxial.ROW_STRAIN * (ROWS + 2),
        sides="rigid",
        tolerance=1e-4,
        step=0.2,
    )
    pressing.prepare(shape, folder / "pressing")
    biaxial.run(folder, **asdict(test))
    return folder / "series.csv"


def column_series(folder):
    heap = column.Column(disks=200, aspect=1.5, seed=1)
    study.one(folder, "column", asdict(heap), {"name": "hard", "path": 0.2, "tolerance": 1e-3}, 12.0)
    return folder / "series.csv"


@pytest.mark.parametrize(
    "name, series", [("slope", slope_series), ("biaxial", biaxial_series), ("column", column_series)]
)
def test_the_first_rows_have_their_bits(name, series, tmp_path):
    found, rows = first_rows(series(tmp_path))
    assert rows >= 0.5 * ROWS  # a column may rest before
    assert found == PINNED[name], f"the bits of the {name} have changed: see {tmp_path}"
