"""Laws of slip surfaces and the block that tries them."""
from mutant import mutant

SLIP = "pkg/contact/slip/"
ZONE, PROFILE, WATER, FLASH = SLIP + "heated_zone.cpp", SLIP + "profile.cpp", SLIP + "water.hpp", SLIP + "flash_heating.cpp"
REACTION, MELT, TABLE, MATERIAL = SLIP + "decomposition.cpp", SLIP + "shear_melting.cpp", SLIP + "tabulated.cpp", "pkg/dem/NscdMat.cpp"
CELLS, GRID = "pkg/dem/SlipSurfaceMat.cpp", "pkg/dem/WallCells.cpp"
SERIES, PICTURE = "py/nonsmooth/studies/slope/surface_series.py", "py/nonsmooth/figures/slip_surface.py"
BUILDING, CHECKS = "py/nonsmooth/model/section/building.py", "py/nonsmooth/model/section/checks.py"
BLOCK, SETS, FIGURE = ("py/nonsmooth/slip/block.py", "py/nonsmooth/slip/parameter_sets.py", "py/nonsmooth/figures/sliding_block.py")

MUTANTS = (
    # ---- functions of slip
    mutant("slip-law-linear", SLIP + "linear.hpp", "slip[k] < critical ? 1 - slip[k] / critical : 0", "slip[k] < critical ? slip[k] / critical : 0",
           "linear weakening begins with nothing", "gtest:SlipLaws.*"),
    mutant("slip-law-step", SLIP + "step.hpp", "slip[k] < critical ? 1 : 0", "slip[k] <= critical ? 1 : 0", "strength is there at D_c still",
           "gtest:SlipLaws.*"),
    mutant("slip-law-exponential", SLIP + "exponential.hpp", "std::exp(-slip[k] / critical)", "std::exp(-slip[k])", "an exponential law does not know D_c",
           "gtest:SlipLaws.*"),
    mutant("slip-what-is-left", SLIP + "by_slip.cpp", "weakened + (friction - weakened) * share[k]", "friction * share[k]",
           "nothing is left of friction in the end", "gtest:SlipLaws.*"),
    # ---- a zone that heats
    mutant("slip-half-zone", ZONE, "1 / (heatCapacity * width())", "2 / (heatCapacity * width())", "all heat goes into one half of the zone",
           "verify:adiabatic-block", "gtest:SlipPressurization.*"),
    mutant("slip-without-foresight", ZONE, "end < 0 || x > 2 ? std::max(B, 0.0) / (1 + x) : 0.5 * (now + end)", "std::max(B, 0.0)",
           "a step's strength does not foresee its own heat", "gtest:SlipPressurization.AStepForeseesTheHeatThatItMakes"),
    mutant("slip-pressure-of-diffusion", ZONE, "s.pressure[k] + expand * (T[k] - s.temperature[k])", "s.pressure[k]",
           "water does not shrink where the zone cools by diffusion", "verify:slip-on-a-plane"),
    mutant("slip-water-stays", ZONE, "ofWater.prepare(mesh, parts.water->diffusivity, h);", "ofWater.prepare(mesh, diffusivity, h);",
           "water diffuses as heat does", "verify:leaking-block", "verify:slip-on-a-plane"),
    mutant("slip-vapour", ZONE, "*s.vapour > 0 ? 0 : q", "q",
           "water that has boiled presses on as a liquid", "gtest:SlipPressurization.WhereWaterBoils*"),
    mutant("slip-nodes-mean", PROFILE, "sum += width[k] * profile[k];", "sum += profile[k] * width.front();", "a zone's mean counts fine nodes as much as coarse ones",
           "verify:leaking-block", "gtest:Slip*"),
    mutant("slip-flux", PROFILE, "0.5 * (nodes.width[k - 1] + nodes.width[k])", "nodes.width[k]", "fluxes have the distance of one node alone",
           "gtest:SlipProfile.*", "verify:leaking-block"),
    mutant("slip-boiling", WATER, "std::exp(-4650 / kelvin)", "std::exp(-4560 / kelvin)",
           "a digit of eq. (14)", "verify:liquid-line", "gtest:SlipWater.*"),
    mutant("slip-flash-square", FLASH, "M_PI * diffusivity / asperity * share * share", "M_PI * diffusivity / asperity * share", "V_w grows with T_w − T and not with its square",
           "verify:flash-heating"),
    mutant("slip-flash-fall", FLASH, "weakened + (friction - weakened) * flashVelocity / slipRate", "friction * flashVelocity / slipRate",
           "hot contacts have no friction", "verify:flash-heating"),
    mutant("slip-flash-lag", ZONE, "-std::expm1(-cells.path[c] / parts.flash->lag)", "-std::expm1(-step / parts.flash->lag)", "friction follows by time and not by slip",
           "gtest:SlipFlash.ALagIsBySlip"),
    mutant("slip-reaction-heat", ZONE, "s.temperature[k] -= reaction.heat / heatCapacity * amount;", "s.temperature[k] -= 0.5 * reaction.heat / heatCapacity * amount;",
           "half of a reaction's heat is lost", "verify:decomposition-caps", "gtest:SlipDecomposition.*"),
    mutant("slip-reaction-explicit", REACTION, "std::max(begin - sink * amount, 1.0)", "std::max(begin, 1.0)",
           "a reaction does not cool itself within a step", "verify:decomposition-caps", "gtest:SlipDecomposition.*"),
    mutant("slip-reaction-order", REACTION, "order == 1 ? left - amount : 1", "1", "what has reacted reacts again", "gtest:SlipDecomposition.*"),
    mutant("slip-melt-profile", MELT, "viscosity * s / (std::sinh(s) * std::cosh(s))", "viscosity * s / std::sinh(s)", "melt is less heated by its shear than it is",
           "verify:melt-layer"),
    mutant("slip-melt-squeezed", MELT, "factor * viscosityAt(slipRate) * length * length", "factor * viscosityAt(slipRate) * length", "melt is squeezed out by R and not by its square",
           "verify:melt-to-steady"),
    mutant("slip-melt-grip", MELT, "std::min(grip, viscosityAt(slipRate) * slipRate / thickness)", "viscosityAt(slipRate) * slipRate / thickness",
           "a thin layer of melt resists without a limit", "gtest:SlipMelting.*"),
    mutant("slip-melt-excess", ZONE, "2 * mesh.width[k] * heatCapacity * (s.temperature[k] - melt.temperature)", "mesh.width[k] * heatCapacity * (s.temperature[k] - melt.temperature)", "heat is lost where the zone melts",
           "gtest:SlipMelting.*"),
    mutant("slip-table-log", TABLE, "slipRate > 0 ? std::log(slipRate) : logs.front()", "slipRate", "a table is read at the velocity for its logarithm",
           "gtest:SlipTable.*", "verify:tabulated-friction"),
    mutant("slip-table-lag", TABLE, "-std::expm1(-cells.path[c] / lag)", "cells.path[c] / lag", "a lag depends on the step", "gtest:SlipTable.*"),
    # ---- the material
    mutant("slip-material", MATERIAL, "law ? law->left(slipOf(id)) : 1", "1", "slip takes nothing from a wall", "test_contact_law.py", "test_soft_walls.py"),
    mutant("slip-material-law", MATERIAL, "law.reset();", "if (law) return checkWeakening();", "a wall keeps the law that it had first", "test_contact_law.py"),
    # ---- cells on walls
    mutant("surface-heat", CELLS, "lostOf[c] / length", "lostOf[c]", "heat of a cell is not that of its area", "test_slip_surface.py"),
    mutant("surface-heat-sum", CELLS, "heat += lostOf[c];", "heat = lostOf[c];", "a wall's heat is that of its last cell", "test_slip_surface.py"),
    mutant("surface-mean-speed", CELLS, "h * meanSpeedOf[c] / weight", "h * speedOf[c] / weight", "a cell slips by the speed of a step's end", "test_slip_surface.py"),
    mutant("surface-stress", CELLS, "std::max(Real(0), pressedOf[c] / (h * length))", "std::max(Real(0), pressedOf[c] / h)", "stress is a force", "test_slip_surface.py"),
    mutant("surface-mean", CELLS, "std::min(Real(1), cells.path[c] / std::min(way, averaging))", "Real(1)", "stress of a cell is that of the last step", "test_slip_surface.py"),
    mutant("surface-friction", CELLS, "cells.strength[c] / cells.normalStress[c]", "first", "friction does not follow the law", "test_slip_surface.py"),
    mutant("surface-forget", CELLS, "		cells.slip.assign(slip.begin(), slip.end());", "		cells.slip.assign(slip.size(), 0);", "slip is forgotten when a scene is loaded", "test_slip_surface.py"),
    mutant("surface-chain", GRID, "alone ? onwards || back : (chain.backwards ? back : onwards)", "true", "walls apart are one", "test_slip_surface.py"),
    mutant("surface-at", GRID, "pieces.push_back({ body.getId(), int(chains.size()) - 1, chain.length, own });", "pieces.push_back({ body.getId(), int(chains.size()) - 1, 0, own });", "each wall begins the chain", "test_slip_surface.py"),
    mutant("surface-backwards", GRID, "chain.backwards ? piece->length - along : along", "along", "cells of a wall that runs back are exchanged", "test_slip_surface.py"),
    mutant("surface-joint", "pkg/dem/NscdPhys.cpp", "phys->cell = surface->cellAt(*Body::byId(id), geom->contactPoint);", "phys->cell = -1;", "a joint of two walls has the strength before slip", "test_slip_surface.py"),
    mutant("surface-arc", GRID, "arc->radius * (std::atan2(local[1], local[0]) + arc->halfAngle)", "arc->radius * std::atan2(local[1], local[0])", "an arc begins in its middle", "test_slip_surface.py"),
    mutant("surface-impacts", "pkg/dem/seam/ContactSeamScatter.cpp", "0.5 * std::abs(u0.t + u1.t)", "std::abs(u0.t + u1.t)", "slip is twice the way", "test_slip_surface.py"),
    mutant("surface-rows", SERIES, '"x_m": middle[:, 0]', '"x_m": middle[:, 1]', "places of cells are exchanged", "test_heated_slopes.py"),
    mutant("surface-hottest", SERIES, ".max(axis=1)", ".min(axis=1)", "the hottest is the coldest", "test_heated_slopes.py"),
    mutant("surface-picture", PICTURE, "np.cumsum(length)", "np.arange(1.0, count + 1)", "cells are drawn as if they were one metre long", "plain:test_figures_slip_surface.py"),
    mutant("surface-law-friction", BUILDING, "if abs(raw[key] - friction) > 1e-5 * (1 + friction):", "if False:", "a wall has another friction than its law", "test_heated_slopes.py"),
    mutant("surface-law-water", CHECKS, "section.release_distance < x1 - x0", "False", "water goes where a law has its own pressure", "test_heated_slopes.py"),
    # ---- the block
    mutant("block-heat", BLOCK, "strength * path, after", "push * path, after", "heat is what the weight does", "test_slip_block.py", "verify:adiabatic-block"),
    mutant("block-up", BLOCK, "max(0.0, speed + gains * (push - strength))", "speed + gains * (push - strength)", "friction drives a block up the slope", "test_slip_block.py"),
    mutant("block-path", BLOCK, "0.5 * (speed + after) * step", "after * step", "a block slides with the speed that it has in the end", "test_slip_block.py"),
    mutant("block-share", BLOCK, "strength < until.share * first", "strength < until.share", "a share is taken for a stress", "test_slip_block.py"),
    mutant("sets-like", SETS, '{**base["values"], **one["values"]}', '{**one["values"], **base["values"]}', "a set that is like another is that one", "test_slip_laws.py"),
    mutant("sets-form", SETS, "dynamic + (static - dynamic) / (1 + speeds / velocity)", "static + (dynamic - static) / (1 + speeds / velocity)",
           "static and dynamic friction are exchanged", "test_slip_laws.py", "verify:tabulated-friction"),
    mutant("block-figure", FIGURE, 'course["pressure_Pa"] / course["normal_stress_Pa"]', 'course["pressure_Pa"]', "pressures are drawn in Pa", "plain:test_figures_sliding_block.py"),
)
