"""A block of some disks, bonded as one, on a plane whose friction and adhesion alone hold it: its factor of safety is
known exactly, dry and with water.
"""

import math

from yade import O
from yade.nonsmooth import section

DIP, LONG, THICK = 30.0, 6.0, 2.0  # degrees, m
GRAVITY, DENSITY, FRICTION, TENSION = 9.81, 2500.0, 0.6, 9.0e3


def along(s, h):
    """The point (x, y) [m] at ``s`` down the plane and ``h`` above it; the plane's foot is the origin."""
    c, d = math.cos(math.radians(DIP)), math.sin(math.radians(DIP))
    return [round(s * c + h * d, 6), round(-s * d + h * c, 6)]


def data(friction=FRICTION, tension=TENSION, table=None, seed=1, dip=DIP):
    """The block as the data of a section file; ``table``: height of the water above the plane [m]."""
    made = {
        "name": "block",
        "walls": [{"name": "plane", "role": "slip", "material": "plane", "vertices": [along(-9, 0), along(9, 0)]}],
        "layers": [
            {
                "name": "block",
                "material": "rock",
                "vertices": [along(-LONG, 0), along(0, 0), along(-0.6 * THICK, THICK), along(-LONG, THICK)],
            }
        ],
        "materials": {
            "rock": {
                "tensile_strength": 1e8,
                "friction": 1.0,
                "rolling_friction": 1.0,
                "bond_creation_distance": 0.2,
                "density": DENSITY,
            },
            "plane": {
                "tensile_strength": tension,
                "residual_tensile_strength": 0.0,
                "friction": friction,
                "rolling_friction": 0.1,
                "bond_creation_distance": 0.2,
            },
        },
        "disks": {"diameter": [0.6, 1.0], "packing_fraction": 0.75},
        "stages": {
            "settle": {"ramp": 0.2, "time_max": 1.0, "speed_rest": 1e-3, "bond": "before"},
            "dry": 0.1,
            "water": {"hold": "never"},
            "end": {"time": 20.0, "rest_fraction": 0.02, "rest_hold": 0.2},
        },
        "numerics": {
            "time_step": 5e-3,
            "tolerance": 1e-6,
            "tolerance_moving": 1e-5,
            "max_iterations": 1000,
            "verlet_distance": 0.6,
        },
        "seed": seed,
    }
    if table is not None:
        made["water"] = {
            "plane": "plane",
            "volume": "disk",
            "table": {"points": [[0, 0], [0.5, table]]},
            "release_distance": 5.0,
        }
    return made


def block(**values):
    """The Section of :func:`data`."""
    return section.of(data(**values))


def exact(strengths, water=(0.0, 0.0)):
    """Factor of safety of the block that is in the running scene, by its disks and its bonds with the plane: what the
    plane bears, μ (Σ F_a + N), over what draws the block. ``strengths``: friction [-] and tensile strength [Pa] of the
    plane; ``water``: the force of the water on all disks, (x, y) [N/m].
    """
    friction, tension = strengths
    c, d = math.cos(math.radians(DIP)), math.sin(math.radians(DIP))
    weight = GRAVITY * sum(b.state.mass for b in O.bodies if hasattr(b.shape, "radius"))
    at_walls = (i for i in O.interactions if not hasattr(O.bodies[i.id1].shape, "radius"))
    bonded = [i for i in at_walls if i.phys.bonded]
    adhesion = tension * sum(2 * O.bodies[i.id2].shape.radius for i in bonded)
    up, down = water[0] * d + water[1] * c, water[0] * c - water[1] * d  # off the plane, and along it
    assert bonded
    return friction * (adhesion + weight * c - up) / (weight * d + down)
