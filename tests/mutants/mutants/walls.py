"""Walls: segments and arcs, their joints, plates under a load, and makers of disks; judged in YADE."""
from mutant import mutant

SEGMENT, JOINTS, JOINTS_H, ARC, ARC_H = (
    f"pkg/dem/walls/{name}" for name in ("Segment.cpp", "WallJoints.cpp", "WallJoints.hpp", "Arc.cpp", "Arc.hpp")
)
PLATE, LOOP, READING = "pkg/dem/engines/PlateLoadEngine.cpp", "pkg/dem/engines/NscdInteractionLoop.cpp", "pkg/dem/seam/ContactState.hpp"
SEAM, CORRECT, SCENE = "pkg/dem/seam/ContactSeam.cpp", "pkg/dem/seam/ContactSeamCorrect.cpp", "py/nonsmooth/world/scene.py"
KEPT = "test_joints.py::test_a_disk_keeps_its_speed_over_joints_of_walls_made"
CORNERS = "test_joints.py::test_corners_of_single_walls_are_those_of_a_polyline"
SWING = "test_arcs.py::test_a_swing_in_a_bowl_keeps_its_energy"

MUTANTS = (
    # ---- segments and joints
    mutant("segment-behind", SEGMENT, "(sense != 0 && near.distance < -radius)", "false", "a one-sided wall catches disks from behind",
           "test_contact_law.py::test_a_one_sided_wall_holds_on_its_side_alone"),
    mutant("joint-ahead", JOINTS_H, "c.dot(o.along)", "-c.dot(o.along)", "corners belong to the wrong one of two walls", "test_contact_law.py::test_convex_corner_is_rounded_with_one_contact"),
    mutant("joint-first", JOINTS_H, "o.first && side >= 0", "o.first && side < 0", "both walls of a corner have it", "test_contact_law.py::test_convex_corner_is_rounded_with_one_contact"),
    mutant("joint-tip", JOINTS_H, "o.first && side >= 0", "o.first", "the part of an acute tip that only the later wall sees belongs to nobody",
           "test_joints.py::test_a_one_sided_tip_is_touched_from_all_sides"),
    mutant("joint-foot", JOINTS, "others.push_back({ Vector3r::Zero(), up, o.sense, true, true });", ";", "the foot of a wall is a bump on the other side",
           "test_joints.py::test_the_foot_of_a_wall_on_another_is_no_bump_on_its_other_side"),
    mutant("joint-apart", JOINTS, "(said ? saidApart : apart) * shorter + round", "saidApart * shorter + round", "ends that stand apart are joined",
           "test_joints.py::test_ends_that_do_not_meet_are_two_corners"),
    mutant("joint-rounding", JOINTS, "(said ? saidApart : apart) * shorter + round", "0", "walls that meet to rounding are not joined", KEPT),
    mutant("joint-mask", JOINTS, "*next == k || o.mask != walls[k].mask", "*next == k", "walls that a disk passes through are joined with others",
           "test_joints.py::test_walls_of_other_masks_are_not_joined"),
    mutant("joint-moved", JOINTS, "position == o.position", "true", "walls that have moved apart stay joined", "test_joints.py::test_walls_that_move_apart_come_apart"),
    mutant("joint-search", JOINTS, "tip.point[0] - widest - most", "tip.point[0] - most", "walls that begin farther to the left are not found", KEPT, CORNERS),
    mutant("joint-said", JOINTS, "alone && b.owns[other.end] && a.yields[end]", "false", "the last corner of a closed wall belongs to the wrong piece", "test_joints.py::test_who_has_a_corner"),
    mutant("joint-followed", JOINTS, "alone && a.owns[end] && b.yields[other.end]", "alone && a.owns[end]", "a piece has a corner with a wall that knows nothing of it, and so has that wall",
           "test_joints.py::test_a_corner_whose_named_follower_has_gone"),
    mutant("joint-shrunk", JOINTS, "size == o.size", "true", "walls that have shrunk stay joined", "test_joints.py::test_walls_that_shrink_come_apart"),
    mutant("joint-opening", JOINTS, "std::abs(std::atan2(here[1], here[0])) < opening", "true", "a wall whose foot lies on the circle of an arc has no end, though the arc has ended",
           "test_arcs.py::test_the_foot_of_a_wall_on_the_circle_of_an_arc"),
    # ---- arcs
    mutant("arc-side", ARC, "arc.radius - side * radius", "arc.radius + side * radius", "the centre's circle is the wall's with the disk on the other side", SWING),
    mutant("arc-curvature", SEAM, "path * turn / (1 + std::sqrt(std::max(Real(0), 1 - turn * turn)))", "0", "a step's path is a tangent, whose end lies in the wall", SWING),
    mutant("arc-correction", CORRECT, "r.curved ? bendOf(r, c) : 0", "0", "errors of position at an arc are those of its tangent", "test_arcs.py::test_an_overlap_is_taken_back_from_a_disk_that_races_round"),
    mutant("arc-bounce", SEAM, "c.biasN < 0 ? std::min(c.biasN, -bias) : c.biasN - bias", "c.biasN - bias", "a disk that swings jumps",
           "test_arcs.py::test_a_disk_with_restitution_swings_and_does_not_jump"),
    mutant("arc-read", READING, "static_cast<const SegmentGeom&>(geom).curvature != 0", "static_cast<const SegmentGeom&>(geom).curvature > 0", "the outside of an arc is taken for flat",
           "test_arcs.py::test_a_disk_follows_the_outside_of_an_arc_without_gaps"),
    mutant("arc-box", ARC, "if (std::abs(angleOf(d, se3.orientation)) <= arc.halfAngle) take(d);", ";", "the box of an arc reaches from end to end", "test_arcs.py"),
    mutant("arc-beyond", ARC_H, "square < least * least || square > most * most", "square < arc.radius * arc.radius || square > most * most", "disks inside a drum are not seen to come", "test_arcs.py"),
    mutant("arc-tip", ARC, "d - arc.radius * tip", "d", "the end of an arc is its centre", "test_arcs.py::test_the_end_of_an_arc_is_a_corner"),
    mutant("arc-way", JOINTS, "z.cross(from)", "from.cross(z)", "an arc begins away from itself", "test_arcs.py::test_a_corner_of_an_arc_and_a_segment_has_one_contact"),
    mutant("arc-bonded", SEAM, "state.bonded && curvature != 0", "false", "a bond to a drum that turns is pushed off its circle",
           "test_arcs.py::test_a_bond_to_a_drum_that_turns_holds"),
    mutant("arc-sense", SCENE, "1 if inside else -1", "-1 if inside else 1", "inside and outside are exchanged", "test_arcs.py::test_a_one_sided_arc_holds_on_its_side_alone"),
    # ---- plates
    mutant("plate-damping", PLATE, "1 + damping * scene->dt / plate.mass", "1", "a stiff damping throws the plate about", "test_plates.py::test_a_damped_plate_comes_to_the_speed_force_by_damping"),
    mutant("plate-weight", PLATE, "total -= plate.mass * gravity;", ";", "a plate presses with its weight as well", "test_plates.py::test_a_free_plate_has_the_acceleration_force_by_mass"),
    mutant("plate-width", PLATE, "cross(to, b) / meets", "to.dot(along)", "a funnel is as wide as its middles are apart", "test_plates.py::test_between_inclined_walls_the_width_is_that_at_the_plate"),
    mutant("plate-posts", PLATE, "b != Vector3r::Zero() && std::abs(meets) < 1e-6", "std::abs(meets) < 1e-6", "a plate cannot stand between disks",
           "test_plates.py::test_between_disks_the_width_is_that_of_their_centres_along_the_plate"),
    mutant("plate-length", PLATE, "std::min(length, std::abs(ends[1] - ends[0]))", "std::abs(ends[1] - ends[0])", "the load grows beyond the plate", "test_plates.py::test_the_load_follows_the_walls_that_move"),
    mutant("plate-guide", PLATE, "phys.adhesion != holdsAll", "false", "the guide of an oblique plate does not pull", "test_plates.py::test_a_plate_with_weight_falls"),
    mutant("plate-soft", PLATE, "total -= all - all.dot(way) * way;", ";", "beside soft contacts an oblique plate leaves its way", "test_plates.py::test_it_works_beside_soft_contacts"),
    # ---- disks of YADE's makers
    mutant("disks-plane", SCENE, "max(heights) - min(heights) > 1e-6", "max(heights) - min(heights) > 1e6", "layers of a packing in space become one", "test_disks.py::test_what_makes_no_disks_is_told"),
    mutant("disks-mass", SCENE, "0.5 * mass * (radius * radius)", "0.4 * mass * (radius * radius)", "disks have a sphere's inertia", "test_disks.py"),
    mutant("disks-blocked", SCENE, 'if k in b.state.blockedDOFs or k in "zXY"', 'if k in "zXY"', "fixed spheres become free disks", "test_disks.py::test_what_is_blocked_stays_blocked"),
)
