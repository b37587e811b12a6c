"""Made-up rows of readings, as laboratory.readings.run returns them: of the paper's own numbers, but for what is
changed.
"""

import math

import numpy as np
import synthetic_slope as synthetic

reading_numbers = synthetic.load("studies.paper.reading_numbers")


def made_up(name, platens, strain_peak=((0.01,) * 3,) * 3, disks=2000, bands=2, **changes):
    """A row with the numbers of the paper and ``changes``. ``strain_peak``: [[under 4, 8, 16 MPa], one list a sample];
    ``disks``, ``bands``: of each of its samples.
    """
    row = {name: wanted for name, (wanted, _) in reading_numbers.PAPER.items()}
    row |= {f"{number}_95": 1.0 for number in reading_numbers.SHOWN}
    row |= {"name": name, "label": name, "platens": platens, "folder": f"samples/{name}/{platens}"}
    row |= {"strain_peak": [list(one) for one in strain_peak], "water_highest_m_each": [22.5] * len(strain_peak)}
    row |= changes
    row["samples"] = [
        {
            "seed": seed,
            "disks": disks,
            "strain_peak": strains[1],
            "deviator_peak_MPa": 24.0,
            "cohesion_peak_kPa": 88.0,
            "bands_at_1_percent": bands,
            "residual_deg": dict.fromkeys(reading_numbers.WINDOWS, 26.2),
        }
        for seed, strains in enumerate(row["strain_peak"], 1)
    ]
    row["misses"] = reading_numbers.misses(row)
    far = list(row["misses"].values())
    return row | {"distance": None if None in far else math.sqrt(np.mean(np.square(far)))}
