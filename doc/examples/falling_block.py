from yade.nonsmooth.scene import disk, engines, segments

rock = NscdMat(density=2500, frictionAngle=0.3, rollingFriction=0.1, tensileStrength=1e5)
ground = NscdMat(frictionAngle=0.2, rollingFriction=0.1, wall=True)
O.materials.append([rock, ground])

# a slope of 30 degrees, a valley floor, and its other side; disks stay to the left of the walls
O.bodies.append(segments([(-52, 30), (0, 0), (60, 0), (90, 30)], ground, piece=5, sense=1))
# a block of 20 by 5 disks of 1 m on the slope: s along it, h above it
for k in range(100):
    s, h = 25 + k % 20, 0.5 + k // 20
    O.bodies.append(disk((-0.866 * s + 0.5 * h, 0.5 * s + 0.866 * h), 0.5, rock))

O.dt = 5e-3
O.engines = engines(gravity=(0, -9.81, 0))
O.step()  # finds the contacts
print("bonds made:", contactDynamics.bond())
for second in range(1, 16):
    O.run(200, wait=True)
    print("%2d s: mean speed %6.3f m/s, %3d bonds left, worst overlap %.1e of a diameter" % (
        second, contactDynamics.meanSpeed, contactDynamics.bonds, contactDynamics.overlapWorst))
