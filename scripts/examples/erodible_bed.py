# What a bed does to a runout: the shipped slope over a valley floor of loose gravel, of gravel that is cemented, and of gravel that cannot move.
# Usage: scripts/yade-nonsmooth scripts/examples/erodible_bed.py [table: section, disks (0: those of the file), seeds (packings of each), folder]
# A section of your own needs a layer with the role bed, and materials called rock, gravel (the bed's) and base (the wall's below it).
# Prints for each bed what became of its slopes, with the water table at failure, the front's travel and the share of the bed that was entrained: means over packings
# and half of their 95 % intervals; FOLDER/beds.json keeps those of the slopes that failed by water. Draws FOLDER/beds.png, one packing of each bed: the first that failed by water on all of them, or seed 1.
import os
from pathlib import Path

from yade import utils
from yade.nonsmooth import campaign, figures, runs, section, section_values
from yade.nonsmooth.measure import statistics
from yade.nonsmooth.system import whole_files

utils.readParamsFromTable(section="interface", disks=1500, seeds=5, folder="out/beds", noTableOk=True)
from yade.params import table

chosen = section.load(table.section)
slope = section_values.given(chosen.with_disks(table.disks) if table.disks else chosen)
slope["layers"] = [layer for layer in slope["layers"] if layer.get("role") != "obstacle"]
rock, gravel, base = (slope["materials"][name] for name in ("rock", "gravel", "base"))
cement = dict(bonded=True, bond_creation_distance=0.05)
BEDS = {
    "loose": (gravel, base),
    "cemented": ({**gravel, **cement, "tensile_strength": 0.3 * rock["tensile_strength"]}, base),
    "rigid": ({**gravel, **cement, "tensile_strength": 1e10}, {**base, **cement, "tensile_strength": 1e10}),
}
FAILED = "failed by water"
NUMBERS = dict(water_m="water_at_failure_m", front_m="front_travel_m", entrained="entrained")

folder, seeds = Path(table.folder), range(1, table.seeds + 1)
told, failed = {}, set(seeds)
for name, (bed, ground) in BEDS.items():
    hill = section.of({**slope, "materials": {**slope["materials"], "gravel": bed, "base": ground}}, name)
    found = campaign.sweep(hill, {"seed": seeds}).run(folder / name, threads=os.cpu_count(), resume=True)
    found["entrained"] = [a / b for a, b in zip(found["entrained_kg_per_m"], found["bed_kg_per_m"])]
    failed &= {seed for seed, verdict in zip(seeds, found["verdict"]) if verdict == FAILED}
    told[name] = {"packings": table.seeds, "failed": 0}
    for row in campaign.means(found, ["seed"]):
        numbers = {key: row["numbers"][column] for key, column in NUMBERS.items()}
        if row["verdict"] == FAILED:
            told[name] |= {"failed": len(row["seeds"]), **numbers}
        water, front, entrained = (
            statistics.told(numbers[key]["mean"], numbers[key]["half_width"], 1, factor)
            for key, factor in (("water_m", 1), ("front_m", 1), ("entrained", 100))
        )
        print(f"{name:10s} {len(row['seeds'])} of {table.seeds} {row['verdict']}: {water} m of water, front {front} m, entrained {entrained} %")
whole_files.write_json(folder / "beds.json", told)

shown = min(failed, default=1)
ends = [runs.open_run(folder / name / "runs" / f"seed={shown}") for name in BEDS]
cases = [(f"{name} bed", run.snapshot("t0"), run.snapshot("end")) for name, run in zip(BEDS, ends)]
print(figures.runouts(cases, hill, folder / "beds.png"))
