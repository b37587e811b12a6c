import pandas

from nonsmooth import campaign, section

hill = section.load("circle").with_disks(250)
plan = campaign.sweep(hill, {"materials.soil.friction": [0.3, 0.5, 0.7], "water.table.rate": [2.0, 4.0, 8.0], "seed": [1, 2]})
table = plan.run("out/sweep", threads=2, resume=True)

runs = pandas.DataFrame(table)
print(runs.groupby(["materials.soil.friction", "water.table.rate"]).water_at_failure_m.agg(["mean", "std", "count"]).round(2))
