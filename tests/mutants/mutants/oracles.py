"""Problems and answers that are held against other people's solvers, in space: Python, judged by pytest."""
from mutant import mutant

VERIFICATION = "py/nonsmooth/judges/verification/"
CONES, PROBLEMS, GRAINS = VERIFICATION + "space/cone_program.py", VERIFICATION + "space/sphere_problems.py", VERIFICATION + "grains.py"
TESTS = "plain:test_space_oracles.py"

MUTANTS = (
    mutant("cones-arm", CONES, "np.cross(arm, frame)", "np.cross(frame, arm)", "spheres turn a contact the wrong way", TESTS + "::test_checks_hold"),
    mutant("cones-cohesion", CONES, "shift[:, NORMAL] = problem.adhesion", "shift[:, NORMAL] = 0 * problem.adhesion", "thresholds of convex programs know no cohesion",
           TESTS + "::test_checks_hold"),
    mutant("cones-disc", CONES, "radius - (p[first] ** 2 + p[second] ** 2) / radius", "radius - np.abs(p[first])", "a disc is a square",
           TESTS + "::test_checks_hold"),
    mutant("cones-held", CONES, "normal = p[:, NORMAL]\n", "pass\n", "thresholds are those of the first guess", TESTS + "::test_checks_hold"),
    mutant("cones-impulse", CONES, "rows[:, [5, 3, 4]]", "rows[:, 3:]", "moments of convex programs have their rows exchanged",
           TESTS + "::test_impulses_of_the_programs_make_their_velocities"),
    mutant("cluster-radical", PROBLEMS, "reach[first] ** 2 - reach[other] ** 2", "reach[other] ** 2 - reach[first] ** 2", "a sphere is put beside those that it should touch",
           TESTS + "::test_a_cluster_of_spheres_touches"),
    mutant("grains-arm", GRAINS, "-(r[j] + 0.5 * gap)]), r[i] + r[j])", "-(r[j] - 0.5 * gap)]), r[i] + r[j])", "the arms of two grains end apart",
           TESTS + "::test_contacts_of_a_cluster_have_their_geometry"),
)  # fmt: skip
