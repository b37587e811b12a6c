"""The law broken on purpose, in a copy of the sources: each mutant replaces a few expressions that must each occur just once.

All mutants stand in one copy, so that it is built once; the environment variable NONSMOOTH_MUTANT chooses one when the library is loaded, and
without it the copy computes as the original does.
"""
from dataclasses import dataclass
from pathlib import Path

HEADER = """#pragma once
#include <cstdlib>
#include <cstring>
namespace nonsmooth::mutant {
inline bool is(const char* name)
{
	const char* chosen = std::getenv("NONSMOOTH_MUTANT");
	return chosen && std::strcmp(chosen, name) == 0;
}
"""


@dataclass(frozen=True)
class Mutant:
    name: str
    broken: str          # what is wrong, in words
    edits: tuple         # (file below pkg, expression, replacement)
    caught_by: tuple     # checks that must fail


MUTANTS = (
    Mutant("rolling", "the rolling torque acts with the wrong sign",
           (("contact/block_kernels.inc", "(at.get(k, &Block::leverTi) * t + r)", "(at.get(k, &Block::leverTi) * t + mutant::sign * r)"),
            ("contact/block_kernels.inc", "(at.get(k, &Block::leverTj) * t + r)", "(at.get(k, &Block::leverTj) * t + mutant::sign * r)"),
            ("contact/problem.hpp", "(c.leverNi * p.n + c.leverTi * p.t + p.r)", "(c.leverNi * p.n + c.leverTi * p.t + mutant::sign * p.r)"),
            ("contact/problem.hpp", "(c.leverNj * p.n + c.leverTj * p.t + p.r)", "(c.leverNj * p.n + c.leverTj * p.t + mutant::sign * p.r)")),
           ("disk-on-an-incline", "spinning-disk", "disk-between-driven-walls", "bond-thresholds", "cantilever", "bridge")),
    Mutant("adhesion", "F_a is missing in the Coulomb threshold",
           (("contact/block_kernels.inc", "clamp<V>(yt - at.get(k, &Block::inverseT) * u.t, at.get(k, &Block::friction) * pressed)",
             "clamp<V>(yt - at.get(k, &Block::inverseT) * u.t, at.get(k, &Block::friction) * (mutant::adhesion ? maxOf<V>(V {}, n) : pressed))"),
            ("contact/block_kernels.inc", "maxOf<V>(zero, at.get(k, &Block::friction) * pressed)",
             "maxOf<V>(zero, at.get(k, &Block::friction) * (mutant::adhesion ? pn : pressed))"),
            ("contact/law.hpp", "c.friction * (c.adhesion + n)", "c.friction * ((mutant::adhesion ? 0 : c.adhesion) + n)")),
           ("bond-thresholds", "residual-thresholds", "bond-ellipse", "cantilever", "bridge")),
    Mutant("gap", "Signorini's condition does not know the gap: contacts act before they touch",
           (("dem/ContactSeam.cpp", "c.biasN = gap / h;", "c.biasN = nonsmooth::mutant::gap ? 0 : gap / h;"),),
           ("landing", "restitution-head-on", "cradle")),
    Mutant("warm-start", "the warm start is not rescaled when the time step changes",
           (("dem/ContactSeam.cpp", "return { h * reading.normal, h * reading.tangential, h * reading.torque };",
             "const Real was = nonsmooth::mutant::warmStart ? nonsmooth::mutant::stepBefore : h;\n"
             "\treturn { was * reading.normal, was * reading.tangential, was * reading.torque };"),
            ("dem/ContactSeamScatter.cpp", "\tscatterForces(scene);", "\tscatterForces(scene);\n\tnonsmooth::mutant::stepBefore = h;")),
           ("changed-time-step",)),
    Mutant("slippery", "contacts have half of their friction",
           (("dem/ContactSeam.cpp", "= reading.friction;", "= nonsmooth::mutant::share * reading.friction;"),),
           ("slider-on-a-plane", "oblique-impact", "disk-on-an-incline", "spinning-disk")),
    Mutant("early", "the solver stops at a million times its tolerance and calls that solved",
           (("contact/solver.cpp", "figure <= settings.tolerance * slack;", "figure <= settings.tolerance * slack * mutant::excess;"),),
           ("stack-of-disks", "elastic-chain")),
)

SWITCHES = """inline const double sign      = is("rolling") ? -1 : 1;
inline const bool   adhesion  = is("adhesion");
inline const bool   gap       = is("gap");
inline const bool   warmStart = is("warm-start");
inline double       stepBefore = 0;
inline const double share     = is("slippery") ? 0.5 : 1;
inline const double excess    = is("early") ? 1e6 : 1;
} // namespace nonsmooth::mutant
"""


def write_header(pkg: Path):
    """The switches, included by the two headers that state the law or its kernels."""
    (pkg / "contact" / "mutant.hpp").write_text(HEADER + SWITCHES)
    for name in ("problem.hpp", "block_kernels.hpp"):
        path = pkg / "contact" / name
        path.write_text(path.read_text().replace("#pragma once\n", "#pragma once\n#include <contact/mutant.hpp>\n", 1))


def apply(pkg: Path):
    """Makes the edits of all mutants in the copy ``pkg``; raises ValueError where an expression does not occur just once."""
    for mutant in MUTANTS:
        for name, old, new in mutant.edits:
            path = pkg / name
            text = path.read_text()
            if text.count(old) != 1:
                raise ValueError(f"mutant {mutant.name}: `{old}` occurs {text.count(old)} times in {name} and must occur once: adapt tests/mutation/mutants.py")
            path.write_text(text.replace(old, new))
    write_header(pkg)
