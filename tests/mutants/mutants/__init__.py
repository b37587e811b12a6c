"""The table of mutants. A new one goes into the file of its subject; see tests/README.md."""
from . import (
    between,
    course,
    dilatancy,
    drawing,
    engines,
    erosion,
    impacts,
    laboratory,
    law,
    oracles,
    plane,
    results,
    safety,
    section_water,
    shaking,
    packing,
    slip,
    solver,
    space,
    space_solver,
    spheres,
    state,
    walls,
    water,
)

MUTANTS = (
    law.MUTANTS
    + solver.MUTANTS
    + space_solver.MUTANTS
    + spheres.MUTANTS
    + plane.MUTANTS
    + engines.MUTANTS
    + between.MUTANTS
    + state.MUTANTS
    + impacts.MUTANTS
    + walls.MUTANTS
    + course.MUTANTS
    + section_water.MUTANTS
    + dilatancy.MUTANTS
    + results.MUTANTS
    + shaking.MUTANTS
    + packing.MUTANTS
    + slip.MUTANTS
    + safety.MUTANTS
    + laboratory.MUTANTS
    + drawing.MUTANTS
    + water.MUTANTS
    + erosion.MUTANTS
    + space.MUTANTS
    + oracles.MUTANTS
)

#: Mutants that no test sees, and why that is left so: {name: reason}.
KNOWN = {
    "gather-closing": "what is wrongly left out is recalled in the same step, and the answer is the same; it costs time alone",
}
