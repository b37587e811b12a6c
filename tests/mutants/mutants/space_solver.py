"""The law and the sweeps in space: plain C++, judged by GoogleTest."""
from mutant import mutant

LAW, PROBLEM, GENERAL = "pkg/contact/space/law.hpp", "pkg/contact/space/problem.hpp", "pkg/contact/space/law.cpp"
KERNELS, FILL, RESIDUAL = "pkg/contact/space/kernels.inc", "pkg/contact/space/passes.inc", "pkg/contact/space/residual.cpp"
SURVEY, CORRECTION, CUT = "pkg/contact/space/classification.cpp", "pkg/contact/space/position_correction.cpp", "pkg/contact/core/strip_cut.cpp"
ONE, MADE, PATHS = "gtest:*SpaceOneContact*", "gtest:SpaceManufactured.*", "gtest:SpacePaths.*"

MUTANTS = (
    # ---- each row of the law
    mutant("balls-normal", LAW, "obeyNormal(c, from.n - inverse.n * opening, inverse.n)", "obeyNormal(c, from.n + inverse.n * opening, inverse.n)",
           "contacts pull where bodies approach", ONE, MADE),
    mutant("balls-disc", LAW, "square > threshold * threshold", "square > threshold", "the radius of a disc is the root of its threshold", ONE, MADE),
    mutant("balls-sliding", LAW, "c.friction * (c.adhesion + n)", "c.friction * n", "F_a is missing in the sliding threshold", ONE, MADE),
    mutant("balls-rolling", LAW, "c.rollingArm * (c.adhesion + n)", "c.twistingArm * (c.adhesion + n)", "rolling has the threshold of twisting", ONE, MADE),
    mutant("balls-twisting", LAW, "c.twistingArm * (c.adhesion + n)", "c.rollingArm * (c.adhesion + n)", "twisting has the threshold of rolling", ONE, MADE),
    mutant("balls-twist-row", LAW, "from.r - inverse.r * (turning - twisting * c.n)", "from.r - inverse.r * turning", "what twists counts as rolling", ONE, MADE),
    mutant("balls-twist-map", LAW, "q.r - inverse.r * (turning - twisting * c.n)", "q.r - inverse.r * turning", "the residual of rolling has what twists", MADE),
    mutant("balls-delassus", LAW, "n + wi * c.leverI * c.leverI + wj * c.leverJ * c.leverJ", "n + wi * c.leverI * c.leverI - wj * c.leverJ * c.leverJ",
           "W_t lacks what the second body turns", MADE),
    mutant("balls-eigenvalue", GENERAL, "0.5 * (aa + bb + std::hypot(aa - bb, 2 * ab))", "0.5 * (aa + bb - std::hypot(aa - bb, 2 * ab))",
           "of bodies that are no balls the step is that of the softest direction", "gtest:SpaceGeneral.*"),
    mutant("balls-turning", GENERAL, "cross(inverse * cross(arm, f), arm)", "cross(arm, inverse * cross(arm, f))", "turning makes a contact stiffer", "gtest:SpaceGeneral.*"),
    mutant("balls-given", LAW, "-threshold / speed * velocity", "threshold / speed * velocity", "bodies whose motion is given are pushed on by friction", "gtest:SpaceGeneral.*"),
    # ---- mechanics
    mutant("balls-spin", PROBLEM, "cross(c.leverJ * vj.w - c.leverI * vi.w, c.n)", "cross(c.leverJ * vj.w + c.leverI * vi.w, c.n)",
           "U_t has the rotation of the first body with the wrong sign", MADE),
    mutant("balls-aside", PROBLEM, "cross(vj.w, c.asideJ) - cross(vi.w, c.asideI)", "cross(vj.w, c.asideJ) + cross(vi.w, c.asideI)",
           "arms across n turn the first body the wrong way", MADE),
    mutant("balls-torque", PROBLEM, "c.leverJ * turn + cross(c.asideJ, p.f) + p.m", "c.leverJ * turn + cross(c.asideJ, p.f) - p.m",
           "moments act on the second body with the wrong sign", MADE, "gtest:SpaceMomentum.*"),
    # ---- the same in blocks
    mutant("balls-kernel-sliding", KERNELS, "at.get(k->friction) * pressed", "at.get(k->rollingArm) * pressed", "in blocks sliding has the threshold of rolling", ONE, MADE),
    mutant("balls-kernel-rolling", KERNELS, "at.get(k->rollingArm) * pressed", "at.get(k->twistingArm) * pressed", "in blocks rolling has the threshold of twisting", ONE, MADE),
    mutant("balls-kernel-twisting", KERNELS, "at.get(k->twistingArm) * pressed", "at.get(k->rollingArm) * pressed", "in blocks twisting has the threshold of rolling", ONE, MADE),
    mutant("balls-kernel-coupled", KERNELS, "u.w + turns * turn", "u.w - turns * turn", "the turn that a tangential impulse gives is taken back from rolling",
           "gtest:SpacePlane.*"),
    mutant("balls-kernel-arm", KERNELS, "at.get(k->leverJ) * b.w - at.get(k->leverI) * a.w", "at.get(k->leverJ) * b.w + at.get(k->leverI) * a.w",
           "in blocks U_t has the rotation of the first body with the wrong sign", MADE),
    mutant("balls-kernel-rest", KERNELS, "push(k, at, df, cross(get(at, k->n), df), m - get(at, k->beforeM), a, b)", "push(k, at, df, cross(get(at, k->n), df), get(at, k->beforeM) - m, a, b)", "a strip that comes to rest leaves spin in velocities",
           "gtest:SpaceStrips.*"),
    mutant("balls-kernel-speeds", KERNELS, "missed + own + least", "missed + least", "speeds are held against themselves", PATHS),
    mutant("balls-kernel-normals", KERNELS, "b.v             = b.v + b.mass * df;", "b.v = b.v - b.mass * df;", "normal impulses of displacements pull the second body",
           "gtest:*SpacePositions*"),
    mutant("balls-fill-bias", FILL, "contact(&Contact::biasN) + un", "un", "blocks do not know the contact's own bias", MADE),
    mutant("balls-fill-given", FILL, "across(&Contact::biasW) + (spinJ - spinI)", "across(&Contact::biasW) - (spinJ - spinI)", "blocks take how free bodies spin for its contrary", MADE),
    mutant("balls-take", FILL, "(square > zero) & (square >= beside * thresholdF * thresholdF)", "square < zero", "contacts that slide are beside their threshold by a rounding of floats",
           "gtest:SpacePrecision.*"),
    mutant("balls-take-open", FILL, "nF <= rounding - adhesionF", "zero < zero", "bonds that open are beside their threshold by a rounding of floats", "gtest:SpacePrecision.*"),
    mutant("balls-fill-aside", FILL, "cross(spinJ, across(&Contact::asideJ)) - cross(spinI, across(&Contact::asideI))", "cross(spinJ, across(&Contact::asideJ))",
           "blocks do not know that a floor turns", MADE, PATHS),
    mutant("balls-fill-turn", FILL, "cross(leverJ * spinJ - leverI * spinI, n)", "cross(leverJ * spinJ + leverI * spinI, n)", "blocks take the first body's spin for its contrary", MADE, PATHS),
    mutant("balls-fill-disc", FILL, "shrink<V>(r, most(rollingArm)) * r", "r", "a warm start has rolling impulses beyond their threshold", PATHS),
    # ---- what is looked at before
    mutant("balls-ball", SURVEY, "(!(j & Classification::turns) || isZero(c.asideJ))", "true", "arms across n go into blocks, which do not know them", MADE),
    mutant("balls-axis", CUT, "axis > 0 && places.axes == 2", "axis > 0", "strips across y and z do not follow the bodies' numbers", "gtest:SpaceSymmetry.AMirrored*"),
    mutant("balls-share", RESIDUAL, "std::max(change(vi, c.leverI, c.asideI), change(vj, c.leverJ, c.asideJ))", "change(vi, c.leverI, c.asideI)",
           "a speed is held against the first body's change alone", "gtest:SpaceGeneral.*"),
    # ---- positions
    mutant("balls-position-slip", CORRECTION, "setVector(k.biasT, l, e.slip);", "setVector(k.biasT, l, {});", "what bonds have slipped is not taken back", "gtest:*SpacePositions*"),
    mutant("balls-position-turn", CORRECTION, "setVector(k.biasW, l, e.turn);", "setVector(k.biasW, l, {});", "what bonds have turned is not taken back", "gtest:*SpacePositions*"),
)
