"""Impacts that follow from impacts in a step: their order, and what the step has of them."""
from mutant import mutant

SEQUENCE, SEAM = "pkg/contact/plane/impact_sequence.cpp", "pkg/dem/seam/ContactSeamImpacts.cpp"
SCATTER, CORRECT, ENGINE = "pkg/dem/seam/ContactSeamScatter.cpp", "pkg/dem/seam/ContactSeamCorrect.cpp", "pkg/dem/engines/ContactDynamicsEngine.cpp"
CHAINS = "test_impacts.py::test_chains_go_as_impacts_in_the_order_of_time"
ELASTIC = "test_impacts.py::test_equal_elastic_disks_hand_their_speed_on_whatever_the_gaps"
GRAVITY, FRICTION, BONDS = (
    "test_impacts.py::test_impacts_of_what_forces_hold_against_gravity_keep_their_balance",
    "test_impacts.py::test_friction_and_spin_act_in_each_impact",
    "test_impacts.py::test_what_hangs_by_bonds_is_hit_by_the_solve_and_its_loss_told",
)

MUTANTS = (
    # ---- the sequence
    mutant("impacts-shift", SEQUENCE, "add(f.shift, -time, f.velocity);", "add(f.shift, time, f.velocity);", "a body that is hit is displaced the wrong way", "gtest:ImpactSequence.*"),
    mutant("impacts-restitution", SEQUENCE, "pair.restitution * std::min(approach[k].n, 0.0)", "0", "impacts that follow have no restitution", "gtest:ImpactSequence.*"),
    mutant("impacts-void", SEQUENCE, "states[c.i].impacts != next.stampI || states[c.j].impacts != next.stampJ", "states[c.i].impacts != next.stampI",
           "a meeting stays though its second body has been hit away", "gtest:ImpactSequence.*"),
    mutant("impacts-last-first", SEQUENCE, "after = wide / (along + std::sqrt(root));", "after = wide / (along - std::sqrt(root));",
           "two disks meet where they would leave each other", "gtest:ImpactSequence.*"),
    mutant("impacts-next-step", SEQUENCE, "time + after <= h", "after <= h", "a step goes on after its end", "gtest:ImpactSequence.*"),
    mutant("impacts-turned", SEQUENCE, "!pair.disks", "true", "disks that pass each other keep their normal", "gtest:ImpactSequence.*"),
    mutant("impacts-rim", SEQUENCE, "c.leverTj = -scene->radius[c.j];", "c.leverTj = c.leverTj;", "a disk touches a wall in the middle of the gap that it had", FRICTION),
    mutant("impacts-alone", SEQUENCE, "alone = false;", "alone = true;", "an impact is left to the solve though its body goes on to others", "gtest:ImpactSequence.*"),
    mutant("impacts-headed", SEQUENCE, "end(scene->before[c.i], scene->before[c.j]) <= 0", "false", "an impact is left to the solve though its body was on its way to another",
           "gtest:ImpactSequence.*"),
    mutant("impacts-most", SEQUENCE, "states[body].impacts >= scene->most && !states[body].frozen", "false", "there is no limit to impacts", "gtest:ImpactSequence.*"),
    mutant("impacts-held", SEQUENCE, "if (here.held || touching.size() > largest) return false;", "if (touching.size() > largest) return false;", "what hangs by bonds is hit as if it did not",
           "gtest:ImpactSequence.*"),
    mutant("impacts-work", SEQUENCE, "-0.5 * p.n * (u0.n + u1.n)", "-0.5 * p.n * u0.n", "the loss of an impact is that on the velocity before it", "gtest:ImpactSequence.*"),
    # ---- the seam
    mutant("impacts-free", SEAM, "v.x + (v1.x - v0.x)", "v.x", "the solve does not know of the impacts before it", ELASTIC),
    mutant("impacts-bias", SEAM, "std::max({ Real(0), (gap - std::min(r.gap, Real(0))) / h, approach })",
           "std::max(Real(0), (gap - std::min(r.gap, Real(0))) / h)", "what has parted is pushed by what comes back, and gains energy", BONDS),
    mutant("impacts-gap", SEAM, "gapOf(c, r)", "r.gap", "gaps are those of bodies that are not displaced", CHAINS),
    mutant("impacts-left-out", SEAM, "if (impactsAt(leftLinks[k])) taken.push_back(k);", "if (false) taken.push_back(k);", "impacts over wide gaps have no reaction",
           "test_impacts.py::test_gaps_wider_than_the_solve_looks_at_are_known_to_impacts"),
    mutant("impacts-sum", SEAM, "p.n += impacts->impulse.n;", "p.n = impacts->impulse.n + 0 * p.n;", "a reaction is that of the impacts alone",
           "test_impacts.py::test_more_impacts_than_allowed_are_told"),
    mutant("impacts-wall-work", SEAM, "(w.x > 0 ? 0 : p.x * v.x)", "-(w.x > 0 ? 0 : p.x * v.x)", "driven walls take what they give",
           "test_impacts.py::test_a_driven_wall_does_the_work_that_disks_have"),
    mutant("impacts-wall-work-up", SEAM, "(w.y > 0 ? 0 : p.y * v.y)", "-(w.y > 0 ? 0 : p.y * v.y)", "walls that are driven upwards take what they give",
           "test_impacts.py::test_a_driven_wall_does_the_work_that_disks_have"),
    mutant("impacts-weight", SEAM, "0.5 * relaxation.step * m", "-0.5 * relaxation.step * m", "the balance has the work of gravity in impacts with the wrong sign", GRAVITY),
    mutant("impacts-lifted", SEAM, "sums.correction -= m * gravity.dot(Vector3r(f.shift.x, f.shift.y, 0));", "sums.correction += m * gravity.dot(Vector3r(f.shift.x, f.shift.y, 0));",
           "what displacements lift is taken for what they lower", GRAVITY),
    mutant("impacts-begun", SCATTER, "followed ? begun[id] : v0", "v0", "the kinetic energy of a step's beginning is that after its impacts", CHAINS),
    mutant("impacts-forces", SCATTER, "r               = { r.x + p.x, r.y + p.y, r.w + p.w };", "r = { r.x + p.x, r.y + p.y, r.w };", "impacts do not turn bodies", FRICTION),
    mutant("impacts-displaced", "pkg/dem/seam/ContactSeam.hpp", "d.y + s.y", "d.y", "bodies are displaced along x alone",
           "test_impacts.py::test_any_frame_and_any_ids_see_the_same_impacts"),
    mutant("impacts-settling", "pkg/dem/engines/ContactDynamicsWarnings.cpp", "again * settling", "0 * settling", "what settles by a micrometre is told of",
           "test_impacts.py::test_what_is_placed_a_little_above_its_place_is_told_of_nothing"),
    mutant("impacts-told", ENGINE, "missedRestitution += s.missed;", "missedRestitution += 0 * s.missed;", "what restitution would have given is not told",
           "test_impacts.py::test_without_impacts_that_are_followed_the_loss_is_told"),
)
