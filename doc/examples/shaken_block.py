"""A block of one disk that does not roll, on a plane that an earthquake shakes, beside Newmark's block."""
import math

from yade.nonsmooth import newmark, scene, shaking
from yade.nonsmooth.ground_motion import synthetic

motion = synthetic.stochastic(peak=4, duration=20, frequency=1.5, seed=3, vertical_peak=2)
dip, friction = 20, 0.45
c, s = math.cos(math.radians(dip)), math.sin(math.radians(dip))

rock = NscdMat(frictionAngle=math.atan(friction), density=2500)
O.materials.append(rock)
plane = O.bodies.append(scene.segments([(-50 * c, 50 * s), (50 * c, -50 * s)], rock))
block = O.bodies.append(scene.disk((0.5 * s, 0.5 * c), 0.5, rock))
O.bodies[block].state.blockedDOFs = "zXYZ"

O.engines = scene.engines(before=[shaking.ground_motion(motion)])  # walls=plane: the plane moves, not the frame
O.dt = 2e-3
while O.time < motion.duration + 2:
    O.step()

way = O.bodies[block].state.pos - O.bodies[plane[0]].state.pos  # it began above the plane's middle
print(f"the disk slid {way[0] * c - way[1] * s:.3f} m")
slide = newmark.slide(newmark.Block(dip=dip, friction=friction), motion)
print(f"Newmark's block slides {slide.permanent:.3f} m")
