"""The law broken at large: what verification checks must see, one of these mutants each and together all of them."""
from mutant import Mutant

KERNELS, PROBLEM, SEAM = "pkg/contact/plane/block_kernels.inc", "pkg/contact/plane/problem.hpp", "pkg/dem/seam/ContactSeam.cpp"


def checks(*names):
    return tuple(f"check:{name}" for name in names)


MUTANTS = (
    Mutant("rolling", "the rolling torque acts with the wrong sign",
           ((KERNELS, "(at.get(k->leverTi) * t + r)", "at.get(k->leverTi) * t - r"),
            (KERNELS, "(at.get(k->leverTj) * t + r)", "at.get(k->leverTj) * t - r"),
            (PROBLEM, "(c.leverNi * p.n + c.leverTi * p.t + p.r)", "c.leverNi * p.n + c.leverTi * p.t - p.r"),
            (PROBLEM, "(c.leverNj * p.n + c.leverTj * p.t + p.r)", "c.leverNj * p.n + c.leverTj * p.t - p.r")),
           checks("disk-on-an-incline", "spinning-disk", "disk-between-driven-walls", "bond-thresholds", "cantilever", "bridge")),
    Mutant("adhesion", "F_a is missing in the Coulomb threshold",
           ((KERNELS, "clamp<V>(yt - at.get(k->inverseT) * u.t, at.get(k->friction) * pressed)",
             "clamp<V>(yt - at.get(k->inverseT) * u.t, at.get(k->friction) * maxOf<V>(V {}, n))"),
            (KERNELS, "maxOf<V>(zero, at.get(k->friction) * pressed)", "maxOf<V>(zero, at.get(k->friction) * pn)"),
            ("pkg/contact/plane/law.hpp", "c.friction * (c.adhesion + n)", "c.friction * n")),
           checks("bond-thresholds", "residual-thresholds", "bond-ellipse", "cantilever", "bridge")),
    Mutant("gap", "Signorini's condition does not know the gap: contacts act before they touch",
           ((SEAM, "c.biasN = !state.bonded && gap > 0 ? gap / h : 0;", "c.biasN = 0;"),), checks("landing", "restitution-head-on", "cradle")),
    Mutant("warm-start", "the warm start is not rescaled when the time step changes",
           ((SEAM, "return { h * state.normal, h * state.tangential, h * state.torque };",
             "static const Real was = h; return { was * state.normal, was * state.tangential, was * state.torque };"),), checks("changed-time-step")),
    Mutant("slippery", "contacts have half of their friction",
           ((SEAM, "c.friction        = state.friction;", "c.friction = 0.5 * state.friction;"),),
           checks("slider-on-a-plane", "oblique-impact", "disk-on-an-incline", "spinning-disk")),
    Mutant("early", "the solver stops at a million times its tolerance and calls that solved",
           (("pkg/contact/core/sweeper.tpp", "residual.missed(tolerance, laidOut.classification.uneven) <= 1", "residual.missed(1e6 * tolerance, laidOut.classification.uneven) <= 1"),), checks("stack-of-disks", "elastic-chain")),
)
