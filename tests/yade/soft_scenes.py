"""A rock and a wall of which soft contacts are made."""
from yade.nonsmooth import section

SIGMA = 1e5
ROCK = section.Material(
    "rock",
    friction=0.9,
    residual_friction=0.9,
    rolling_friction=0.3,
    residual_rolling_friction=0.3,
    density=2500.0,
    bonded=False,
)
WALL = section.Material(
    "wall",
    friction=0.5,
    residual_friction=0.3,
    rolling_friction=0.2,
    residual_rolling_friction=0.1,
    tensile_strength=SIGMA,
)
