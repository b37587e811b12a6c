"""Disks on a conveyor belt: fed at one end, carried along, thrown off at the other. Prints how fast they go on the belt."""
from collections import deque

from yade.nonsmooth.scene import disk, engines, segments

SPEED, PIECE, COUNT = 2.0, 0.5, 20  # of the belt [m/s], length of its pieces [m], number
stone = NscdMat(density=2500, frictionAngle=0.5, rollingFriction=0.05)
O.materials.append(stone)
O.bodies.append(segments([(8, -3), (20, -3), (20, 0)], stone, sense=1))  # a bin below the end, at x = 10


def piece(x):
    """A piece of the belt that begins at x and moves to the right; returns its id. Its ends find those of its neighbours by themselves."""
    (i,) = O.bodies.append(segments([(x, 0), (x + PIECE, 0)], stone, sense=1))
    O.bodies[i].state.vel = (SPEED, 0, 0)
    return i


belt = deque(piece(k * PIECE) for k in range(COUNT))


def turn():
    """The belt has gone by a piece: the one that has come round the end is put to the beginning."""
    O.bodies.erase(belt.pop())
    belt.appendleft(piece(O.bodies[belt[0]].state.pos[0] - 1.5 * PIECE))


def feed():
    O.bodies.append(disk((1, 0.25), 0.15, stone))


O.dt = 1e-3
O.engines = engines(after=[
    PyRunner(command="turn()", iterPeriod=round(PIECE / SPEED / O.dt), initRun=False),
    PyRunner(command="feed()", iterPeriod=500),
])
O.run(10000, wait=True)
disks = [b for b in O.bodies if isinstance(b.shape, Sphere)]
carried = [b.state.vel[0] for b in disks if 4 < b.state.pos[0] < 9 and b.state.pos[1] > 0]
print(f"disks fed {len(disks)}, in the bin {sum(b.state.pos[1] < 0 for b in disks)}")
print(f"speed on the belt [m/s] {min(carried):.4f} to {max(carried):.4f}")
