"""A gas of elastic disks in a box: prints its pressure on the walls beside that of the equation of state, and how its speeds are spread."""
import math
import random

from yade.nonsmooth.scene import disk, engines, segments
from yade.nonsmooth.wall_forces import WallForces

SIDE, RADIUS, ROWS = 10.0, 0.1, 18
smooth = NscdMat(density=1, frictionAngle=0, restitution=1)
O.materials.append(smooth)
box = O.bodies.append(segments([(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)], smooth, sense=1, closed=True))
dice, gas = random.Random(2), []
for k in range(ROWS * ROWS):
    gas.append(O.bodies.append(disk((0.5 + 0.53 * (k % ROWS), 0.5 + 0.53 * (k // ROWS)), RADIUS, smooth)))
    angle = dice.uniform(0, 2 * math.pi)
    O.bodies[gas[-1]].state.vel = (math.cos(angle), math.sin(angle), 0)  # all with 1 m/s, in all directions

O.dt = 1e-3
O.engines = engines(gravity=(0, 0, 0))
O.run(5000, wait=True)  # until they have met each other some times
walls = WallForces({"box": box})
O.run(15000, wait=True)
measured = walls.take()["box"][0] / (4 * SIDE)

speeds = [O.bodies[i].state.vel for i in gas]
energy = sum(0.5 * O.bodies[i].state.mass * v.squaredNorm() for i, v in zip(gas, speeds))
area = (SIDE - 2 * RADIUS) ** 2  # where centres may be
share = len(gas) * math.pi * RADIUS**2 / area
expected = energy / area * (1 + share**2 / 8) / (1 - share) ** 2  # Henderson (1975)
squares = [v[k] ** 2 for v in speeds for k in (0, 1)]
kurtosis = sum(s * s for s in squares) / len(squares) / (sum(squares) / len(squares)) ** 2
print(f"disks {len(gas)}, share of the area {share:.3f}")
print(f"pressure [N/m] {measured:.4e}, by the equation of state {expected:.4e}")
print(f"kurtosis of the velocities {kurtosis:.2f}, in equilibrium 3, in the beginning 1.5")
