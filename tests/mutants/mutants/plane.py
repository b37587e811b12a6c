"""Motion, contacts of disks, bonds and thresholds in the plane: plain C++, judged by GoogleTest."""
from mutant import mutant

CLUSTERS = "pkg/contact/plane/rigid_clusters.cpp"
MOTION, DISKS, BOND, THRESHOLDS = (f"pkg/contact/plane/{name}.hpp" for name in ("motion", "disk_contact", "bond", "thresholds"))

MUTANTS = (
    # ---- motion
    mutant("plane-path", MOTION, "m.position.x += v.x * h;", "m.position.x += 0.5 * v.x * h;", "a body goes half of its way", "gtest:PlaneMotion.*"),
    mutant("plane-gravity", MOTION, "0.0 + (force.y / mass + gravity.y)", "0.0 + (force.y + gravity.y) / mass", "heavy bodies fall more slowly", "gtest:PlaneMotion.*"),
    mutant("plane-torque", MOTION, "force.w / inertia", "force.w / mass", "a torque has the mass in the place of the inertia", "gtest:PlaneMotion.*"),
    mutant("plane-blocked", MOTION, "blocked & blockedTurn", "blocked & blockedY", "who is held in y does not turn", "gtest:PlaneMotion.*"),
    mutant("plane-half", MOTION, "0.5 * (speed * h)", "speed * h", "a body turns by twice its spin", "gtest:PlaneMotion.*"),
    mutant("plane-sense", MOTION, "std::sin(half) * (v.w / speed)", "std::sin(half)", "all bodies turn counter-clockwise", "gtest:PlaneMotion.*"),
    mutant("plane-product", MOTION, "a.w * b.w - a.z * b.z", "a.w * b.w + a.z * b.z", "rotations do not add up", "gtest:PlaneMotion.*"),
    mutant("plane-zero", MOTION, "0.0 * v.x - 0.0 * v.y", "0.0", "a zero has another sign than Eigen's", "gtest:PlaneBits.*"),
    mutant("plane-normal", MOTION, "m.rotation = normalized(m.rotation);", "m.rotation.z += 0;", "errors of a rotation's length add up", "gtest:PlaneMotion.*:PlaneBits.*"),
    mutant("plane-displaced", MOTION, "0.5 * d.w", "d.w", "a displacement turns twice as far", "gtest:PlaneMotion.*"),
    mutant("plane-back", MOTION, "2 * (0.0 - q.z * v.x)", "2 * (0.0 + q.z * v.x)", "vectors do not come back into the body's frame", "gtest:PlaneMotion.*"),
    # ---- contacts of disks
    mutant("plane-gap", DISKS, "r1 + r2 - distance", "r1 + r1 - distance", "the second disk is as large as the first", "gtest:PlaneDisks.*"),
    mutant("plane-point", DISKS, "r1 - 0.5 * overlap", "r1 - overlap", "contacts lie on the second disk's surface", "gtest:PlaneDisks.*"),
    mutant("plane-height", DISKS, "(dy * dy + dz * dz)", "(dy * dy)", "disks out of the plane seem to touch", "gtest:PlaneDisks.*"),
    mutant("plane-lever", DISKS, "-(rj + 0.5 * gap)", "-(ri + 0.5 * gap)", "the lever of the second disk is the first one's", "gtest:PlaneDisks.*"),
    # ---- bonds
    mutant("plane-mark", BOND, "x2.y - secondRadius * normal.y", "x2.y + secondRadius * normal.y", "a bond is marked on the far side of its second disk", "gtest:PlaneBond.*"),
    mutant("plane-tangent", BOND, "n.x * dy - n.y * dx", "n.y * dx - n.x * dy", "a bond's shear has the other sign", "gtest:PlaneBond.*"),
    mutant("plane-well-inside", BOND, "std::abs(d.normal) <= 0.5 * zone.normal && std::abs(d.tangential) <= 0.5 * zone.tangential",
           "std::abs(d.normal) <= 0.75 * zone.normal && std::abs(d.tangential) <= 0.75 * zone.tangential", "the corners of a square inside the ellipse lie outside of it", "gtest:PlaneBond.*"),
    mutant("plane-ellipse", BOND, "d.tangential / zone.tangential", "d.tangential / zone.normal", "the ellipse of a bond is a circle", "gtest:PlaneBond.*"),
    mutant("plane-first-gap", BOND, "std::max(gap, 0.0)", "gap", "a bond keeps an overlap", "gtest:PlaneBond.*"),
    mutant("plane-rest-gap", BOND, "std::max(restGap, gap)", "gap", "a bond that was pulled out springs back", "gtest:PlaneBond.*"),
    mutant("plane-opens", BOND, "openingOf(c, u) > 0", "true", "a bond that is held at its threshold has yielded", "gtest:PlaneBond.*"),
    mutant("plane-yield-shear", BOND, "reached * slidingThreshold(c, p.n)", "reached * rollingThreshold(c, p.n)", "a bond counts as sheared at the rolling threshold", "gtest:PlaneBond.*"),
    mutant("plane-yield-arm", BOND, "std::abs(h * u.r) * 0.5 * c.length", "std::abs(h * u.r) * c.length", "the path of rolling has the diameter for its arm", "gtest:PlaneBond.*"),
    mutant("plane-break", BOND, "if (path.shear > bound) return BreakMode::Shear;", "if (path.shear > bound) return BreakMode::Torque;", "broken in shear and by torque are one",
           "gtest:PlaneBond.*"),
    mutant("plane-mixed", BOND, "path.tension + (path.shear + path.torque)", "path.shear + path.torque", "a break in tension is one whatever else yielded", "gtest:PlaneBond.*"),
    mutant("plane-slip", BOND, "leverFirst * aboutFirst + leverSecond * aboutSecond", "leverFirst * aboutFirst - leverSecond * aboutSecond", "rolling counts as slip", "gtest:PlaneBond.*"),
    mutant("plane-turn", BOND, "aboutFirst - aboutSecond", "aboutSecond - aboutFirst", "a bond's turn has the other sign", "gtest:PlaneBond.*"),
    mutant("plane-arc", BOND, "sine * (1 + sine * sine / 6)", "sine", "an arc is taken for its chord", "gtest:PlaneBond.*"),
    # ---- clusters
    mutant("clusters-centre", CLUSTERS, "all.mass[*b] / mass", "1.0 / (last - first)", "a cluster turns about the middle of its disks", "gtest:RigidClusters.*"),
    mutant("clusters-load", CLUSTERS, "h * axes.velocity.w * axes.velocity.w", "h * axes.velocity.w", "the centrifugal force grows as the spin", "gtest:RigidClusters.*"),
    mutant("clusters-path", CLUSTERS, "place.x - r.x - h * end.x", "place.x - r.x", "a cluster goes its way twice", "gtest:RigidClusters.*"),
    mutant("clusters-momentum", CLUSTERS, "spin *= axes.inertia / inertia", "spin *= 1", "what is not rigid changes the angular momentum", "gtest:RigidClusters.*"),
    mutant("clusters-driven", CLUSTERS, "axes.turns && !isDriven", "axes.turns", "a rotor turns as fast as what hangs on it", "gtest:RigidClusters.*"),
    mutant("clusters-guided", CLUSTERS, "(w.x == 0) != (w.y == 0)", "false", "a body on a rail is turned with the others", "gtest:RigidClusters.*"),
    mutant("clusters-rigid", CLUSTERS, "square <= rigidEnough * rigidEnough * turn * turn * axes.inertia", "square >= rigidEnough * rigidEnough * turn * turn * axes.inertia", "what bends is turned as one", "gtest:RigidClusters.*"),
    # ---- thresholds
    mutant("plane-residual", THRESHOLDS, "if (bonded) return bond;", "return bond;", "a contact without a bond has the bond's strengths", "gtest:PlaneThresholds.*"),
    mutant("plane-adhesion", THRESHOLDS, "touching ? residual.adhesion : 0", "residual.adhesion", "residual adhesion acts over the whole reach", "gtest:PlaneThresholds.*"),
    mutant("plane-range", THRESHOLDS, "gap <= range * length", "gap <= range", "the range of adhesion is in metres", "gtest:PlaneThresholds.*"),
)
