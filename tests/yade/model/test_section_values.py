"""A value that is changed in a section gives what a file with this value gives, whatever follows from it and however it
is changed: key by key of the schema, by campaigns, after --disks, in a mirror and at another size."""

import argparse
import copy
import dataclasses
import tempfile
from pathlib import Path

import pytest
import yaml
from test_section_keys import BASE, SCHEMA, WHERE
from yade.nonsmooth import campaign, packing, section, section_values, similar
from yade.nonsmooth.commands import section_arguments
from yade.nonsmooth.laboratory import materials
from yade.nonsmooth.model.section import data as section_data, powers as section_powers, reader as section_reader
from yade.nonsmooth.studies.slope import slope_run

# with the numbers as a section file has them
with tempfile.TemporaryDirectory() as folder:
    (Path(folder) / "base.yaml").write_text(yaml.safe_dump(BASE, sort_keys=False))
    BASE = section_reader.read(Path(folder) / "base.yaml", section.FOLDER / "section.schema.yaml").data
# what a file need not say: it follows from the rest
FILLED = ("gravity", "seed", "stages", "numerics", "description")
BARE = {k: v for k, v in copy.deepcopy(BASE).items() if k not in FILLED}
BARE["disks"] = {"diameter": BASE["disks"]["diameter"]}
BARE["water"] = {"plane": "DP", "table": {"rate": 1.0}}
for rock in BARE["materials"].values():
    rock.pop("residual_friction", None)
    rock.pop("residual_rolling_friction", None)
BASES = {"all is said": BASE, "what must be": BARE}


def changes():
    """Changes of test_section_keys for every key of the schema: (name, {way: value})."""
    for way, cases in WHERE.items():
        for k, (change, *_) in enumerate(cases if isinstance(cases, list) else [cases]):
            if change:
                yield pytest.param(change, id=f"{'-'.join(way)}{k}")


def with_(base, change):
    """Data of a file with these values, put in by hand; without those that are None."""
    made = copy.deepcopy(base)
    for way, value in change.items():
        place = made
        for word in way[:-1]:
            place = place.setdefault(word, {}) if isinstance(place, dict) else place[word]
        if value is None:
            place.pop(way[-1], None)
        else:
            place[way[-1]] = copy.deepcopy(value)
    return made


def keys_of(change, base):
    """The same change with the keys of an override: words, and names for the numbers of items."""
    found, made = {}, copy.deepcopy(base)
    for way, value in change.items():
        words, place = [], made
        for word in way:
            place = place.get(word, {}) if isinstance(place, dict) else place[word] if isinstance(place, list) else {}
            words.append(place["name"] if isinstance(word, int) else word)
        found[tuple(words)] = value
        made = with_(made, {way: value})
    return found


def same(one, other):
    """Whether two Sections are equal, but for where they come from."""
    return dataclasses.replace(one, source="") == dataclasses.replace(other, source="")


@pytest.mark.parametrize("base", BASES.values(), ids=BASES)
@pytest.mark.parametrize("change", changes())
def test_a_value_gives_what_a_file_with_it_gives(change, base, tmp_path):
    path = tmp_path / "hill.yaml"
    base = with_(base, {way: None for way, value in change.items() if value is None})
    change = {way: value for way, value in change.items() if value is not None}
    try:
        path.write_text(yaml.safe_dump(with_(base, change), sort_keys=False))
        wanted = section.load(str(path))
    except section.SectionError as refused:  # then the override is refused alike
        with pytest.raises(section.SectionError) as too:
            section.of(base).with_values(keys_of(change, base))
        assert str(too.value).partition(": ")[2] == str(refused).split(": ", 2)[2]
        return
    path.write_text(yaml.safe_dump(base, sort_keys=False))
    hill, values = section.load(str(path)), keys_of(change, base)
    made = hill.with_values(values)
    assert same(made, wanted) and made.source == hill.source
    if not any("." in word for words in values for word in words):
        [run] = campaign.sweep(hill, {".".join(words): [value] for words, value in values.items()}).runs
        # a count has become diameters there
        assert same(section.of(run.arguments["data"]), section.of(section_data.plain(wanted)))
    if ("disks", "count") not in change:
        assert same(hill.with_disks(400).with_values(values), wanted.with_disks(400))
    if base["disks"] == BASE["disks"] or any(m.slip_law is not None for m in made.materials.values()):
        return  # what heats has no similar slope, which test_heated_slopes holds
    # four times as large: powers of two, so to the last bit
    large = {words: similar.original_value(words, value, 1 / 4) for words, value in values.items()}
    if "stretch" not in change.get(("shaking",), {"stretch"}):  # a record that is there already keeps its proportion
        large[("shaking", "stretch")] = 2.0
    if "field" in change.get(("water",), ()):  # and so do files of a field
        large[("water",)]["field"] = {"scale": 4.0, "stretch": 2.0, **large[("water",)]["field"]}
    there, asked = similar.scaled(hill, 4).with_values(large), similar.scaled(wanted, 4)
    assert same(there, asked)
    assert same(there.like[0], wanted) and there.like[1] == 4
    assert same(section.of(section_values.given(similar.mirrored(wanted))), similar.mirrored(wanted))


def test_what_follows_follows():
    hill = section.of(BARE)
    surface = hill.with_values({"materials.dp.friction": 0.33}).materials["dp"]
    assert (surface.friction, surface.residual_friction) == (0.33, 0.33)
    moon = hill.with_values({"gravity": 9.81 / 4})
    assert moon.water.unit_weight == pytest.approx(hill.water.unit_weight / 4, rel=1e-15)
    assert moon.numerics.time_step == pytest.approx(2 * hill.numerics.time_step, rel=1e-15)  # √(d/g)
    assert moon.stages.end.time == pytest.approx(2 * hill.stages.end.time, rel=1e-15)
    # what is said stays
    said = section.of(with_(BARE, {("materials", "dp", "residual_friction"): 0.4, ("water", "unit_weight"): 9000.0}))
    changed = said.with_values({"materials.dp.friction": 0.33, "gravity": 2.0})
    assert changed.materials["dp"].residual_friction == 0.4 and changed.water.unit_weight == 9000.0


def test_a_sweep_over_friction_is_one_over_friction():
    plan = campaign.sweep(section.of(BARE), {"materials.dp.friction": [0.45, 0.5, 0.55]})
    frictions = [section.of(one.arguments["data"]).materials["dp"].residual_friction for one in plan.runs]
    assert frictions == [0.45, 0.5, 0.55]


def test_with_and_replace_count_as_given():
    hill = section.of(BARE)
    later = dataclasses.replace(hill, seed=7).with_values({"gravity": 4.0})
    assert later.seed == 7 and same(later, section.of({**BARE, "seed": 7, "gravity": 4.0}))
    # numerics that were replaced are said, so that the step stays
    coarse = dataclasses.replace(hill, numerics=dataclasses.replace(hill.numerics, time_step=1e-3))
    assert coarse.with_values({"gravity": 4.0}).numerics.time_step == 1e-3
    dry = dataclasses.replace(hill, water=None).with_values({"gravity": 4.0})
    assert dry.water is None and dry.gravity == 4.0
    slid = hill.with_critical_slip(3.0).with_values({"gravity": 4.0})
    assert slid.critical_slips == {"DP": 3.0} and slid.release_distance == 3.0
    assert slid.water.unit_weight == pytest.approx(4000.0)
    assert hill.with_disks(80).with_disks(60) == hill.with_disks(60)
    pressed = dataclasses.replace(hill, pressed=True).with_values({"seed": 3})
    assert pressed.pressed and pressed.seed == 3


def test_a_rock_has_what_its_file_says(tmp_path):
    path = tmp_path / "clay.yaml"
    path.write_text("friction: 0.3\nrolling_friction: 0.1\ntensile_strength: 2.0e4\ndensity: 2100\n")
    by_file = section.of(BARE).with_rock(materials.data(path)).with_values({"materials.rock.friction": 0.6})
    assert by_file.materials["rock"].residual_friction == 0.6 and by_file.materials["rock"].density == 2100.0
    whole = section.of(BARE).with_rock(materials.load(path)).with_values({"materials.rock.friction": 0.6})
    assert whole.materials["rock"].residual_friction == 0.3  # a Material says all its values
    assert section.of(BARE).with_rock(materials.load("wwr")).materials["rock"] == dataclasses.replace(
        materials.load("wwr"), name="rock"
    )
    with pytest.raises(section.SectionError, match="no density, and layers are to be made of it"):
        section.of(BARE).with_rock(dataclasses.replace(materials.load(path), density=None))


def test_arguments_of_a_command_are_given_values(tmp_path):
    rock, hill = tmp_path / "clay.yaml", tmp_path / "hill.yaml"
    rock.write_text("friction: 0.3\nrolling_friction: 0.1\ntensile_strength: 2.0e4\ndensity: 2100\n")
    hill.write_text(yaml.safe_dump(BARE, sort_keys=False))
    parser = argparse.ArgumentParser()
    section_arguments.add(parser)
    words = [
        "--section",
        str(hill),
        "--rock",
        str(rock),
        "--water",
        "5",
        "--seed",
        "3",
        "--disks",
        "400",
        "--critical-slip",
        "2",
    ]
    made = section_arguments.read(parser.parse_args(words)).with_values(
        {"gravity": 4.0, "materials.rock.friction": 0.6, "materials.dp.friction": 0.2}
    )
    assert made.materials["rock"].residual_friction == 0.6 and made.materials["dp"].residual_friction == 0.2
    assert (made.water.rate, made.water.unit_weight, made.seed, made.disks.count) == (5.0, 4000.0, 3, 400)
    assert made.critical_slips == {"DP": 2.0} and made.numerics == section.of({**BARE, "gravity": 4.0}).numerics


class Stop(Exception):
    pass


def test_a_run_of_a_similar_section_is_packed_as_its_original(monkeypatch, tmp_path):
    hill = section.of(BASE).with_disks(60)
    large = similar.scaled(hill, 3.0)
    [run] = campaign.sweep(large, {"materials.rock.tensile_strength": [1e4]}).runs
    begun = []

    def begin(made, folder, progress):
        begun.append(made)
        raise Stop

    monkeypatch.setattr(slope_run.experiment, "begin", begin)
    with pytest.raises(Stop):
        slope_run.run(tmp_path, **run.arguments)
    made, there = packing.pack(begun[0], 5), similar.scaled_packing(packing.pack(hill, 5), 3.0)
    assert made.checksum == there.checksum
    assert begun[0].materials["rock"].tensile_strength == 1e4  # as it is run, not as the file's


def test_a_section_that_is_scaled_twice_is_packed_as_the_first_one():
    """By powers of two, so to the last bit; there and back it is packed as it was."""
    hill = section.of(BASE).with_disks(60)
    twice, once = similar.scaled(similar.scaled(hill, 4.0), 0.5), similar.scaled(hill, 2.0)
    assert same(twice, once) and twice.like[0] is hill and twice.like[1] == 2.0
    mirrored = similar.mirrored(once)
    assert same(mirrored, similar.scaled(similar.mirrored(hill), 2.0)) and mirrored.like[1] == 2.0
    assert same(mirrored.like[0], similar.mirrored(hill))


@pytest.mark.parametrize("now, foreseen, share", [(5.0, 20.0, 0.25), (20.0, 20.0, 1.0), (30.0, 20.0, 1.0)])
def test_a_process_of_a_campaign_notes_how_far_its_slope_is(tmp_path, monkeypatch, now, foreseen, share):
    """Of the time that it foresees; one that runs longer is at its end."""

    def begin(made, folder, progress):
        progress("slide", now, foreseen)
        raise Stop

    monkeypatch.setattr(slope_run.experiment, "begin", begin)
    with pytest.raises(Stop):
        slope_run.run(tmp_path, BASE)
    assert float((tmp_path / "progress").read_text()) == share


# powers of the ratio of lengths, by Froude with the same gravity and density
UNITS = {"m": 1, "Pa": 1, "s": 0.5, "m/s": 0.5, "N/m³": 0, "kg/m³": 0, "m/s²": 0, "degrees": 0}


def units(part):
    """Units that a schema's description names, as ``[m]`` or ``in s and m``."""
    words = part.get("description", "").replace(",", " ").replace("[t h]", "").split("; or")[0]
    return [u for word in words.replace("[", " ").replace("]", " ").split() if (u := word.strip("().;:")) in UNITS]


def test_a_value_grows_with_the_slope_as_its_unit_does():
    found = {}
    for way in WHERE:
        place = SCHEMA
        for word in way:
            inside = place["items"] if place.get("type") == "array" else place
            if word == "*":
                place = inside if inside is not place else inside["additionalProperties"]
            else:
                place = inside["properties"][word]
        if "$ref" in place:
            place = SCHEMA["$defs"]["point"]
        named = units(place)
        key = ".".join(word for word in way if word != "*")
        if key == "water.table.points":
            named = ["s", "m"]
        if key.startswith("shaking.synthetic."):  # stretched as a record is
            named = []
        if key in ("shaking.stretch", "water.field.stretch"):
            named = ["s"]
        if key == "water.field.scale":  # of the lengths of files
            named = ["m"]
        powers = [UNITS[u] for u in dict.fromkeys(named)]
        if key == "erosion.path":  # of triples
            powers = [*powers, UNITS["m"]]
        found[key] = tuple(powers) if len(powers) > 1 else powers[0] if powers else 0
    assert {key: power for key, power in found.items() if power} == section_powers.POWERS


@pytest.mark.parametrize(
    "key, message",
    [
        ("materials.rok.friction", "there is no 'rok' in materials of the section; did you mean 'rock'"),
        ("walls.no.material", "there is no 'no' in walls of the section; there are DP, FB, SS"),
        ("seed.more", "there is no 'more' in seed of the section; nothing can be varied there"),
        ("stages.dry.more", "there is no 'more' in stages.dry of the section; nothing can be varied there"),
        ("disks.diameter.0", "there is no '0' in disks.diameter of the section; items without names"),
        ("walls.DP", "'DP' is an item of walls and no value; give one of its keys, walls.DP.material"),
        ("nothing.of.this", "there is no 'nothing' in the section; there are name, description"),
    ],
)
def test_a_key_that_leads_nowhere_is_named(key, message):
    with pytest.raises(section_values.NoSuchKey) as refused:
        section.of(BASE).with_values({key: 1})
    assert str(refused.value).startswith(f"{key}: {message}")


def test_groups_that_a_file_has_not_are_made():
    bare = {k: v for k, v in BARE.items() if k != "water"}
    made = section.of(bare).with_values({"stages.end.time": 12.0, "layers.L1.disks.diameter": [0.9, 1.1]})
    assert made.stages.end.time == 12.0 and made.layers[0].disks.d_min == 0.9
    with pytest.raises(section.SectionError, match="water: the key 'plane' is missing"):
        section.of(bare).with_values({"water.table.rate": 1.0})
    assert section.of(bare).water is None  # the first is as it was


@pytest.mark.parametrize(
    "key, value, original",
    [
        ("water.seepage.conductivity", 1e-5, 5e-6),  # speeds go with the root of the size
        ("water.seepage.conductivity.rock", 1e-5, 5e-6),
        ("water.seepage.conductivity.rock.along", 1e-5, 5e-6),
        ("water.seepage.conductivity.rock.dip", 30.0, 30.0),
        ("materials.rock.tensile_strength", 4e5, 1e5),
        ("materials.dp.slip_weakening.critical_slip", 8.0, 2.0),
        ("layers.L1.disks.diameter", [4.0, 8.0], [1.0, 2.0]),
        ("gravity", 9.81, 9.81),
    ],
)
def test_a_value_of_a_slope_four_times_as_large_is_that_of_its_original(key, value, original):
    assert similar.original_value(key, value, 4.0) == pytest.approx(original, rel=1e-12)


def test_a_key_before_one_that_holds_it_is_refused():
    """Its value would be lost; the other way round both count."""
    table = {"points": [[0.0, 0.0], [10.0, 5.0]]}
    made = section.load("jiufengershan")
    with pytest.raises(section.SectionError, match="water.table.points and water.table: .* name water.table first"):
        made.with_values({"water.table.points": table["points"], "water.table": table})
    with pytest.raises(section.SectionError, match="water.rate and water: the value of the second takes the place"):
        made.with_values({("water", "rate"): 2.0, "water": {}})
    law = {"law": "step", "critical_slip": 2.0, "friction": 0.0}
    values = {"materials.dp.slip_weakening": law, "materials.dp.slip_weakening.critical_slip": 3.0}
    assert made.with_values(values).critical_slips == {"DP": 3.0}
