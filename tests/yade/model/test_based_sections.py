"""Section files that begin from another one. Needs no YADE."""

import sys
from pathlib import Path

import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import section  # noqa: E402


@pytest.fixture
def load(tmp_path):
    """Loads a file of this content, beside those of `others`, {name: content}."""

    def run(content, **others):
        for name, one in {"slope": content, **others}.items():
            (tmp_path / f"{name}.yaml").write_text(yaml.safe_dump(one) if isinstance(one, dict) else one)
        return section.load(str(tmp_path / "slope.yaml"))

    return run


def test_the_same_as_its_base(load):
    assert load({"base": "circle"}).key("settled") == section.load("circle").key("settled")


def test_single_values_differ(load):
    """Maps are put together at any depth; lists are not."""
    base = section.load("circle")
    made = load({"base": "circle", "name": "other", "materials": {"soil": {"friction": 0.5}}, "water": None})
    assert made.name == "other" and made.water is None and made.walls == base.walls
    assert made.materials["soil"].friction == 0.5 and made.materials["soil"].density == base.materials["soil"].density
    assert made.materials["surface"] == base.materials["surface"]
    fewer = [item for item in yaml.safe_load((section.FOLDER / "circle.yaml").read_text())["walls"]][:2]
    assert len(load({"base": "circle", "walls": fewer}).walls) == 2


def test_a_key_that_is_null_is_left_out_for_its_default(load):
    base = section.load("circle")
    made = load({"base": "circle", "numerics": {"path": None}})
    assert base.numerics.path == 0.1 and made.numerics.path is None


def test_bases_of_bases_and_files_beside(load):
    made = load({"base": "second.yaml", "seed": 7}, second={"base": "circle", "seed": 5, "gravity": 9.0})
    assert (made.seed, made.gravity, made.layers) == (7, 9.0, section.load("circle").layers)


def test_base_may_be_in_another_folder(tmp_path):
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "a.yaml").write_text("base: ../b.yaml\nseed: 9\n")
    (tmp_path / "b.yaml").write_text("base: circle\n")
    assert section.load(str(tmp_path / "inner" / "a.yaml")).seed == 9


@pytest.mark.parametrize(
    "content, words",
    [
        (
            {"base": "nowhere"},
            "line 1: base: 'nowhere' is no shipped section; give one of acads_1a, acads_1c, chair, circle",
        ),
        ({"base": "section.schema"}, "base: there is no file section.schema"),
        ({"base": "other.yaml"}, "base: there is no file other.yaml"),
        ({"base": 3}, "base: 3 is no name"),
        ({"base": "slope.yaml"}, "base: more than 5 files build on each other"),
        ({"base": "circle", "gravety": 1}, "gravety: unknown key; did you mean 'gravity'?"),
        ("base: circle\nseed: 1\nmaterials:\n  soil:\n    friction: -1\n", "line 5: materials.soil.friction: -1"),
    ],
)
def test_what_is_no_base_is_refused(load, content, words):
    with pytest.raises(section.SectionError) as info:
        load(content)
    assert words in str(info.value) and "\n" not in str(info.value)


def test_a_schema_of_the_package_is_no_base(load):
    with pytest.raises(section.SectionError, match="base: "):
        load({"base": "section.schema"})
