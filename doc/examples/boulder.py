"""A boulder of 37 bonded disks tumbles down a slope and rolls out in the valley. Prints its turns, its bonds and its energy."""
import math

from yade.nonsmooth.scene import disks, engines, segments

rock = NscdMat(density=2700, frictionAngle=0.6, tensileStrength=5e8)
ground = NscdMat(frictionAngle=0.6, rollingFriction=0.02, wall=True)
O.materials.append([rock, ground])
DIP, RADIUS = math.radians(30), 0.25
O.bodies.append(segments([(-40 * math.cos(DIP), 40 * math.sin(DIP)), (0, 0), (60, 0)], ground, piece=5, sense=1))

# a hexagon of touching disks, three to a side from its middle one, a little above the slope
rows = []
for j in range(-3, 4):
    for i in range(7 - abs(j)):
        rows.append((2 * RADIUS * (i - 0.5 * (6 - abs(j))), math.sqrt(3) * RADIUS * j, RADIUS))
up = 7.2 * RADIUS
x0, y0 = -38 * math.cos(DIP) + up * math.sin(DIP), 38 * math.sin(DIP) + up * math.cos(DIP)
boulder = O.bodies.append(disks([(x0 + x, y0 + y, r) for x, y, r in rows], rock))

O.dt = 1e-3
O.engines = engines(gravity=(0, 0, 0))  # bonds are made before the weight acts
O.step()
made = contactDynamics.bond()
O.engines = engines()
middle = boulder[18]
turned, before, fastest = 0.0, O.bodies[middle].state.ori, 0.0
while O.time < 8:
    contactDynamics.advance(20)
    now = O.bodies[middle].state.ori
    axis, angle = (now * before.conjugate()).toAxisAngle()
    turned, before = turned + angle * axis[2] / (2 * math.pi), now
    fastest = max(fastest, O.bodies[middle].state.vel.norm())
print(f"bonds made {made}, broken {contactDynamics.brokenTension + contactDynamics.brokenShear + contactDynamics.brokenTorque + contactDynamics.brokenMixed}")
print(f"turns {-turned:.2f}, largest speed [m/s] {fastest:.2f}, way [m] {O.bodies[middle].state.pos[0] - x0:.1f}")
print(f"error of the energy [of the height's] {contactDynamics.energyError / (37 * O.bodies[middle].state.mass * 9.81 * y0):.1e}")
