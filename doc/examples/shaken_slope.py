"""A dry hill on ground that shakes: three periods of a sine to and fro, after it has come to rest. Prints how far it was from rest before, during and after."""
import math

from yade.nonsmooth import experiment, section

AMPLITUDE, PERIOD, BEGIN, PERIODS = 3.0, 1.0, 8.0, 3  # m/s², s, s of simulated time, number
soil = dict(tensile_strength=1e5, friction=0.6, rolling_friction=0.3, bond_creation_distance=0.05, density=2500.0)
ground = dict(bonded=False, friction=0.7, rolling_friction=0.4)
hill = section.of(
    name="Shaken hill",
    walls=[dict(name="rock", role="slip", material="ground", vertices=[(-62, 26.3), (0, 0)]),
           dict(name="valley", role="ground", material="ground", vertices=[(0, 0), (90, 2), (110, 25)])],
    layers=[dict(name="soil", material="soil", vertices=[(0, 0), (-5, 8), (-48, 27), (-54, 22.9065)])],
    materials=dict(soil=soil, ground=ground), disks=dict(diameter=(1.2, 2.4)),
    stages=dict(end=dict(time=BEGIN + PERIODS * PERIOD + 3)))

run = experiment.begin(hill, "out/shaken")
speeds = []


def shake():
    """The ground's acceleration, which pushes the hill the other way; gravity is the run's own until then."""
    phase = (O.time - BEGIN) / PERIOD
    if 0 <= phase <= PERIODS:
        run.newton.gravity = (-AMPLITUDE * math.sin(2 * math.pi * phase), -hill.gravity, 0)
    elif phase > PERIODS:
        run.newton.gravity = (0, -hill.gravity, 0)
    speeds.append((O.time, run.slope.solver.meanSpeed))


run.attach()
solver = O.engines.index(run.slope.solver)
O.engines = O.engines[:solver] + [PyRunner(command="shake()", iterPeriod=1)] + O.engines[solver:]  # before the reactions are found
O.run(wait=True)
for name, first, last in (("before", BEGIN - 2, BEGIN), ("shaken", BEGIN, BEGIN + PERIODS * PERIOD), ("after", BEGIN + PERIODS * PERIOD + 2, 1e9)):
    print(f"{name}: largest mean speed [m/s] {max((v for t, v in speeds if first <= t < last), default=0):.4f}")
print(f"end of the run [s] {O.time:.1f}, disks {len(run.layers)}")
