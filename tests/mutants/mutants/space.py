"""Spheres in space on YADE's side, bonds there, facets that meet, and scripts that go hard."""
from mutant import mutant

SEAM, BOND, LAW = "pkg/dem/space/SpaceSeam.cpp", "pkg/dem/space/SpaceBond.cpp", "pkg/contact/space/bond.hpp"
FACE, JOINTS, NEAR, PHYS = "pkg/dem/space/FaceGeom.cpp", "pkg/dem/space/FaceJoints.cpp", "pkg/contact/space/nearest.hpp", "pkg/dem/space/NscdSpacePhys.cpp"
HARD = "py/nonsmooth/world/hardening"
SPACE, OPEN, HARDENING = "test_space.py", "test_space_open_gaps.py", "test_hardening.py"
KEPT, LOOP, VIEW = "pkg/dem/space/SpaceContacts.cpp", "pkg/dem/engines/NscdInteractionLoopInSpace.cpp", "test_space_view.py"
RANDOM = "test_random_programs.py::test_a_program_of_spheres_does_the_same_in_every_way"

MUTANTS = (
    mutant("space-gap", SEAM, "!s.bonded && s.gap > 0 ? s.gap / h : 0", "0", "a sphere stops above its floor", SPACE + "::test_two_balls_meet_with_restitution"),
    mutant("space-bounce", SEAM, "c.biasN = s.restitution * approach;", ";", "impacts in space have no restitution", SPACE + "::test_two_balls_meet_with_restitution"),
    mutant("space-aside", SEAM, "acrossNormal(c.n, a)", "(space::Vector {})", "a floor that turns does not lift what lies far from its axis",
           SPACE + "::test_a_floor_that_turns_about_an_axis_far_away_moves_as_its_points_do"),
    mutant("space-order", KEPT, "ball1 && ball2 ? id1 > id2 : ball1", "ball1 && ball2 ? false : ball1", "a contact runs as YADE happens to keep it", SPACE + "::test_a_contact_runs_from_the_lower_id_whatever_order_yade_keeps"),
    mutant("space-left-out", "pkg/dem/space/SpaceSeamRecall.cpp", "relaxation.openGap * s.length", "HUGE_VAL", "contacts that stay open are solved for", OPEN + "::test_a_contact_that_stays_open_is_left_out_and_bears_nothing"),
    mutant("space-left-bears", "pkg/dem/space/SpaceSeamRecall.cpp", "s.normalForce = s.shearForce = s.rollingTorque = {};", "", "a contact that was left out bears what it bore before", OPEN + "::test_a_contact_that_stays_open_is_left_out_and_bears_nothing"),
    mutant("space-recall", "pkg/dem/space/SpaceSeamRecall.cpp", "if (!taken.empty()) takeIn(taken);", "return 0;", "who is hit in a step goes into the next", OPEN + "::test_who_is_hit_in_a_step_stops_at_the_next"),
    mutant("space-recall-order", "pkg/dem/space/SpaceSeamRecall.cpp", "ids(solved[o]) > ids(left[taken[a]].place)", "false", "contacts that are taken in stand behind all others", OPEN + "::test_contacts_that_are_taken_in_together_stand_in_the_order_of_ids"),
    mutant("space-follow", "pkg/dem/space/SphereGeometry.hpp", "(first.radius - 0.5 * depth) * normal", "first.radius * normal", "contact points do not lie in the middle of a gap", OPEN + "::test_a_contact_has_the_geometry_that_its_functor_would_give"),
    mutant("space-reach", "py/nonsmooth/world/space.py", "REACH = 0.12", "REACH = 0.05", "fast spheres overlap before they are seen", OPEN + "::test_what_is_fast_does_not_overlap"),
    mutant("space-wall-arm", SEAM, "both ? 0.5 * s.gap : 0", "0.5 * s.gap", "a sphere that hits a wall turns about where the step began", "test_space_impacts.py::test_4_an_oblique_impact_slides_or_comes_to_roll"),
    # ---- contacts that stay in arrays
    mutant("kept-adhesion", LOOP, "nonsmooth::contact::plane::touches(s.gap, ours.law->adhesionRange, s.length)", "true", "contacts in the arrays that have opened keep their tensile strength", RANDOM),
    mutant("kept-reach", LOOP, "if (!ours.law->isWithinReach(s.gap, s.length)) return false;", "", "contacts in the arrays never end", VIEW + "::test_contacts_that_open_beyond_the_reach_end_unseen"),
    mutant("kept-refused", LOOP, "!stays", "false", "a pair that its law refuses is a contact", RANDOM),
    mutant("kept-lost", LOOP, "id < (int)bodies.size() && bodies[id].present && bodies[id].plain", "true", "contacts of bodies that are gone stay", RANDOM),
    mutant("kept-again", LOOP, "contacts.lookAgain(slot);", ";", "a contact that got another physics keeps the old one", VIEW + "::test_a_fixed_ball_that_is_let_go_during_a_run_in_the_background_is_borne"),
    mutant("kept-written", KEPT, "phys.touched || phys.isWritten()", "false", "what is written during a run in the background is written over", VIEW + "::test_a_force_that_is_written_unseen_is_refused_once_it_is_looked_at"),
    mutant("kept-geometry", KEPT, "geom.penetrationDepth = -s.gap;", ";", "a look finds the overlap that was there when a contact was taken", VIEW + "::test_every_attribute_is_the_same_in_every_way"),
    mutant("kept-correction", KEPT, "phys.correction     = s.correction;", ";", "the correction of a contact that was looked at begins anew", VIEW + "::test_every_attribute_is_the_same_in_every_way"),
    mutant("kept-order", KEPT, "isBefore(added[a], order[o])", "false", "new contacts stand behind all others", VIEW + "::test_every_attribute_is_the_same_in_every_way", RANDOM),
    mutant("kept-stamp", KEPT, "areKnown && now == seen", "areKnown", "pairs that the collider finds are not looked at", VIEW + "::test_pairs_that_the_collider_finds_become_contacts_unseen"),
    mutant("kept-ended", KEPT, "return real == (long)order.size();", "return true;", "contacts that a script has ended unseen go on", RANDOM),
    mutant("kept-bonded", KEPT, "!s.phys->bonded && !s.phys->breaks", "true", "bonds stay in arrays that do not know them", RANDOM),
    mutant("kept-blind", "pkg/dem/seam/Audience.cpp", "what == LooksAt::Contacts && isBlindToContacts(*engine)", "false", "advance() shows contacts to a collider that does not look", VIEW + "::test_contacts_stay_as_they_were_seen_until_somebody_looks_again"),
    mutant("released-bond", "pkg/dem/materials/NscdPhys.cpp", "made->bonded = static_cast<const NscdPhys&>(*interaction.phys).bonded;", ";", "who is let go leaves its bond", VIEW + "::test_a_bond_of_two_fixed_balls_holds_one_that_is_let_go"),
    mutant("released-strengths", "pkg/dem/materials/NscdPhys.cpp", "setStrengths(*made, b1, b2);", ";", "who is let go has no friction", VIEW + "::test_a_fixed_ball_that_is_let_go_has_contacts_in_space"),
    mutant("triaxial-weight", HARD + "/triaxial.py", "before - goal * area * O.dt / state.mass", "before + goal * area * O.dt / state.mass", "walls go away from the sample", "test_hardening_triaxial.py::test_a_wall_that_nothing_holds_goes_at_its_speed"),
    mutant("triaxial-memory", HARD + "/triaxial.py", "last.append(float(inward * state.vel[axis]) if state.blockedDOFs != _HELD else 0.0)", "last.append(0.0)", "walls forget how fast they went", "test_hardening_triaxial.py::test_a_wall_that_is_driven_back_bears_its_force_and_no_more"),
    mutant("triaxial-damping", HARD + "/triaxial.py", "controller.strainDamping **= longer", "controller.strainDamping **= 1", "strains begin a hundred times too late", "test_hardening_triaxial.py::test_one_axis_strains_at_the_rate_and_the_others_bear_their_stress"),
    mutant("triaxial-moves", HARD + "/triaxial.py", "state.pos -= state.vel * O.dt", "pass", "plates that the older engine drives go twice as far", "test_hardening_triaxial.py::test_the_older_engine_compacts_and_loads_and_its_recorder_writes"),
    mutant("space-shear-work", "pkg/dem/space/SpaceSeamScatter.cpp", "0.5 * dot(rows.t, u0.t + u1.t)", "dot(rows.t, u1.t)", "sliding loses what it loses at the end of the step", SPACE + "::test_energy_is_accounted_for"),
    mutant("space-moment-work", "pkg/dem/space/SpaceSeamScatter.cpp", "0.5 * dot(p.m, u0.w + u1.w)", "0", "rolling and twisting lose nothing", SPACE + "::test_energy_is_accounted_for"),
    mutant("space-reaction", "pkg/dem/space/SpaceSeamScatter.cpp", "rj.w + (c.leverJ * turn + cross(c.asideJ, p.f) + p.m)", "rj.w + (c.leverJ * turn + cross(c.asideJ, p.f))", "O.forces has no torque of rolling resistance",
           SPACE + "::test_rolling_resistance_stops_a_ball_that_rolls"),
    mutant("space-bond-shear", LAW, "if (path.shear > bound) return BreakMode::Shear;", "", "what was sheared is a mixed break", SPACE + "::test_a_bonded_pair_that_is_sheared_breaks_in_shear"),
    mutant("space-bond-twist-axis", LAW, "d.twist / zone.twisting", "0 * d.twist", "a twist breaks no bond", SPACE + "::test_a_bond_that_is_overloaded_breaks_in_the_mode_of_its_load"),
    mutant("space-bond-twist-sign", BOND, "angle / length * sine.dot(phys.axis)", "angle / length * sine.norm()", "a roll counts as a twist", SPACE + "::test_a_roll_is_no_twist"),
    mutant("space-bond-path", "pkg/dem/space/SpaceSeamScatter.cpp", "phys.twistingPath += y.twisting;", "", "what was twisted off is a mixed break", SPACE + "::test_a_bond_that_is_overloaded_breaks_in_the_mode_of_its_load"),
    mutant("space-area", PHYS, "*force *= areaOf(length) / length;", "*force *= 1;", "a bond in space is as strong as a metre of one in the plane", SPACE + "::test_a_bond_bears_its_threshold_and_no_more"),
    mutant("space-twisting-arm", PHYS, "length * pick([](const NscdMat& m) { return m.twistingFriction; })", "0.5 * length * pick([](const NscdMat& m) { return m.twistingFriction; })", "a bond bears half of its twisting torque", SPACE + "::test_a_bond_bears_its_threshold_and_no_more"),
    mutant("space-residual-twisting", PHYS, "bonded ? twistingArm : residualTwistingArm", "twistingArm", "without a bond the peak's twisting friction holds", SPACE + "::test_without_a_bond_the_residual_twisting_friction_holds"),
    mutant("faces-owner", JOINTS, "if (other.id < own.id) return false;", "", "a ridge has two contacts", SPACE + "::test_a_ball_on_a_ridge_has_one_contact_and_in_a_groove_two"),
    mutant("faces-goes-on", JOINTS, "there.feature == space::Nearest::Face", "false", "a ball feels the edges of a floor of facets", SPACE + "::test_facets_that_lie_in_one_plane_are_one_floor"),
    mutant("faces-lost", "pkg/dem/materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.cpp", "(face && !face->owned)", "false", "a contact stays at the facet that the ball has left",
           SPACE + "::test_facets_that_lie_in_one_plane_are_one_floor"),
    mutant("faces-edge", NEAR, "within ? from + s * along : s <= 0 ? from : t.at(k + 1)", "s <= 0 ? from : t.at(k + 1)", "an edge is its two ends", SPACE + "::test_a_ball_on_a_ridge_has_one_contact_and_in_a_groove_two"),
    mutant("harden-cohesion", HARD + "/strengths.py", "per_area = 1 / math.pi if disk_radius is None", "per_area = 1 if disk_radius is None", "cohesion in space acts on a radius squared",
           HARDENING + "::test_a_material_keeps_its_strengths"),
    mutant("harden-rolling", HARD + "/strengths.py", "0.5 * max(0.0, soft.etaRoll)", "max(0.0, soft.etaRoll)", "rolling resistance is twice YADE's", HARDENING + "::test_a_material_keeps_its_strengths"),
    mutant("harden-fall", HARD + "/steps.py", "math.sqrt(2 * g * fall)", "0", "the step forgets that spheres fall", HARDENING + "::test_the_step_is_a_tenth_of_the_smallest_diameter_at_the_greatest_speed"),
    mutant("harden-period", HARD + "/scene.py", "engine.iterPeriod = after", "pass", "engines act a hundred times too seldom", HARDENING + "::test_engines_act_after_the_same_time"),
    mutant("harden-functor", HARD + "/strengths.py", "restitution=restitution or 0", "restitution=0", "the functor's restitution is lost", HARDENING + "::test_restitution_comes_from_the_functor_or_the_caller"),
    mutant("harden-time", HARD + "/script.py", "max(1, round(steps * self._soft_step / omega.dt))", "steps", "a script's number of steps is taken for rigid ones", HARDENING + "::test_a_script_runs_hard_as_it_is"),
    mutant("harden-later", HARD + "/script.py", "self.hardened.take(omega.bodies)", "pass", "bodies that a script adds stay soft", HARDENING + "::test_a_script_runs_hard_as_it_is"),
)
