"""The shipped slope with short stages and a looser solve, so that a coarse run takes seconds."""

from pathlib import Path

import yaml

SHIPPED = Path(__file__).resolve().parents[2] / "py" / "nonsmooth" / "sections" / "jiufengershan.yaml"
SMALL = Path(__file__).resolve().parents[1] / "data" / "small_slope.yaml"
QUICK = {
    "packing_fraction: 0.848": "packing_fraction: 0.82",
    "ramp: 4.0": "ramp: 1.0",
    "time_max: 30.0": "time_max: 1.5",
    "dry: 3.0": "dry: 0.5",
    "tolerance: 1e-6": "tolerance: 1e-4",
    "max_iterations: 300": "max_iterations: 60",
}

# So few disks would not hold with the paper's strength; friction is that of the rock, of its copy, and of the plane.
STRONG = {"friction: 0.3\n": "friction: 0.8\n", "tensile_strength: 100.0e3": "tensile_strength: 100.0e6"}


def write_quick(folder, strong=False):
    """Writes the section file into a folder; returns its path. ``strong``: of a rock that stands with some hundred
    disks.
    """
    text = SHIPPED.read_text()
    for old, new in QUICK.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    for old, new in STRONG.items() if strong else ():
        text = text.replace(old, new)
    path = Path(folder) / "quick.yaml"
    path.write_text(text)
    return path


def write_changed(folder, change, source=SMALL):
    """Writes a section file whose data ``change(data)`` has changed; returns its path."""
    data = yaml.safe_load(Path(source).read_text())
    change(data)
    path = Path(folder) / "changed.yaml"
    path.write_text(yaml.safe_dump(data, sort_keys=False))
    return path
