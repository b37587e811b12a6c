# What a bed does to a runout: the shipped slope over a valley floor of loose gravel, of gravel that is cemented, and of gravel that cannot move.
# Usage: scripts/yade-nonsmooth scripts/examples/erodible_bed.py [table: section, disks (0: those of the file), folder]
# A section of your own needs a layer with the role bed, and materials called rock, gravel (the bed's) and base (the wall's below it).
# Draws FOLDER/beds.png and prints, for each bed, the water table at failure, the front's travel and the share of the bed that was entrained.
from pathlib import Path

from yade import utils
from yade.nonsmooth import experiment, figures, records, section, section_values

utils.readParamsFromTable(section="interface", disks=1500, folder="out/beds", noTableOk=True)
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

cases = []
for name, (bed, ground) in BEDS.items():
    hill = section.of({**slope, "materials": {**slope["materials"], "gravel": bed, "base": ground}}, name)
    run = experiment.begin(hill, Path(table.folder) / name)
    run.run()
    told = run.summarise()
    entrained = 100 * told["entrained_kg_per_m"] / told["bed_kg_per_m"]
    print(f"{name:10s} {told['water_at_failure_m'] or float('nan'):6.1f} m of water, front {told['front_travel_m']:6.1f} m, entrained {entrained:5.1f} %")
    cases.append((f"{name} bed", *(records.read_snapshot(run.folder / f"{when}.npz") for when in ("t0", "end"))))
print(figures.runouts(cases, hill, Path(table.folder) / "beds.png"))
