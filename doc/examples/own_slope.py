from yade.nonsmooth import experiment, section

soil = dict(tensile_strength=2e4, friction=0.4, rolling_friction=0.1, bond_creation_distance=0.05, density=2500.0)
joint = dict(bonded=False, friction=0.5, rolling_friction=0.1, slip_weakening=dict(law="linear", critical_slip=0.5, friction=0.1))
ground = dict(bonded=False, friction=0.4, rolling_friction=0.1)
hill = section.of(
    name="My hill",
    walls=[dict(name="joint", material="joint", vertices=[(-62, 26.3), (0, 0)]),
           dict(name="valley", material="ground", vertices=[(0, 0), (90, 2), (110, 25)])],
    layers=[dict(name="soil", material="soil", vertices=[(0, 0), (-5, 8), (-48, 27), (-54, 22.9065)])],
    materials=dict(soil=soil, joint=joint, ground=ground), disks=dict(diameter=(0.8, 1.6)),
    water=dict(plane="joint", table=dict(rate=0.5)))

run = experiment.begin(hill, "out/hill")
run.run()  # or run.attach() and O.run()
print("fails at", run.summarise()["water_at_failure_m"], "m of water; figures:", *(path.name for path in run.draw()[0]))
