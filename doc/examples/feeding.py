"""Disks that come and go: fed into a hopper at a steady rate, erased below its outlet. Prints how many are there, and the flow."""
import random

from yade.nonsmooth.scene import disk, engines, segments

grain = NscdMat(density=2500, frictionAngle=0.4)
O.materials.append(grain)
# a hopper of 45° with an outlet of 0.6 m, about eight disks wide; disks are to the left of its walls' ways
O.bodies.append(segments([(-2, 4), (-2, 2), (-0.3, 0.3)], grain, sense=1))
O.bodies.append(segments([(0.3, 0.3), (2, 2), (2, 4)], grain, sense=1))
dice, there, gone = random.Random(1), set(), []


def feed():
    """Ten disks a time, in a row above the hopper, with speed downwards."""
    for k in range(10):
        i = O.bodies.append(disk((-1.35 + 0.3 * k, 4.2), dice.uniform(0.03, 0.045), grain))
        O.bodies[i].state.vel = (0, -2, 0)
        there.add(i)


def erase():
    """What has fallen out; not while O.bodies is gone through."""
    for i in [i for i in there if O.bodies[i].state.pos[1] < -1]:
        O.bodies.erase(i)
        there.remove(i)
        gone.append(O.time)


O.dt = 1e-3
# they fall at up to 10 m/s, a tenth of a diameter a step: known that early
O.engines = engines(far=0.3, after=[PyRunner(command="feed()", iterPeriod=100), PyRunner(command="erase()", iterPeriod=50)])
O.run(10000, wait=True)
late = sum(t > 5 for t in gone)
print(f"fed {len(there) + len(gone)}, in the scene {len(there)}, erased {len(gone)}")
print(f"a second: fed 100.0, erased from 5 s on {late / 5:.1f}")
print(f"deepest overlap of all steps [of a diameter] {contactDynamics.overlapWorstEver:.1e}")
