"""Packings have the bits that they had when NumPy made them, on any number of threads: published numbers rest on
them.
"""

import dataclasses
import hashlib
import sys
from pathlib import Path

import numpy as np
import numpy_packing
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import packing, similar  # noqa: E402
from nonsmooth.model import geometry  # noqa: E402
from nonsmooth.packing import relaxation  # noqa: E402
from nonsmooth.section import load  # noqa: E402


def digest(*arrays):
    return hashlib.sha256(b"".join(np.ascontiguousarray(a, "<f8").tobytes() for a in arrays)).hexdigest()


def sized(name, count, **disks):
    """A shipped section with so many disks, and other disks where they are given."""
    section = load(name)
    return dataclasses.replace(section, disks=dataclasses.replace(section.disks, **disks)).with_disks(count)


SECTIONS = {
    "shipped": (lambda: sized("jiufengershan", 700), (2, 3)),
    "flat interfaces": (lambda: sized("interface", 1500), (3,)),
    "reflex corners": (lambda: sized("undercut", 500), (1,)),
    "bowl": (lambda: sized("chair", 500), (1,)),
    "one size": (lambda: sized("jiufengershan", 400, d_min=5.0, d_max=5.0, packing_fraction=0.78), (1,)),
    "sizes of one to twelve": (lambda: sized("jiufengershan", 1500, d_min=1.0, d_max=12.0, packing_fraction=0.8), (1,)),
}


@pytest.mark.parametrize("name, seed", [(name, seed) for name, (_, seeds) in SECTIONS.items() for seed in seeds])
def test_sections_have_the_packings_that_they_had(name, seed):
    section = SECTIONS[name][0]()
    made = packing.pack(section, seed)
    assert digest(made.x, made.y, made.r) == digest(*numpy_packing.pack(section, seed))
    if name == "flat interfaces":
        assert any(interface.flat for interface in section.interfaces)


def test_a_slope_that_falls_to_the_left_has_the_packing_that_it_had():
    left = similar.mirrored(sized("jiufengershan", 400, packing_fraction=0.8))
    made, (x, y, r) = packing.pack(left, 1), numpy_packing.pack(similar.mirrored(left), 1)
    assert left.side < 0 and digest(made.x, made.y, made.r) == digest(-x, y, r)


def test_a_packing_of_known_bits():
    """The oracle is of this machine's NumPy; these bits are of all."""
    made = packing.pack(sized("jiufengershan", 700), 3)
    assert made.checksum == "9c0ef82803d4bf1cc5c93195f2d90fd81c45210f8d4afb83c50a28d0c9c2b454"


def crowd(count, widest, seed=5):
    """Disks thrown into a bent region of two layers with a wall between them, too many to go in without an overlap, the
    largest `widest` times as large as the smallest; a third of the first layer has rounded sizes, so that many are equal.
    """
    dice = np.random.default_rng(seed)
    r = np.exp(dice.uniform(0, np.log(widest), count))
    size = np.sqrt(np.sum(np.pi * r * r) / 0.84 / 1.5)
    x, y = size * dice.random((2, count))
    y = np.where(dice.random(count) < 1 / 3, y / 2 - size / 2, y)
    layer = (y < 0).astype(np.int64)
    some = np.flatnonzero(layer == 0)[::3]
    r[some] = np.round(r[some], 1)
    corners = [
        (0, -size / 2),
        (size, -size / 2),
        (1.2 * size, 0.4 * size),
        (size, size),
        (0.5 * size, 0.8 * size),
        (0, size),
    ]
    above, below = geometry.sides([(0, 0), (size / 2, 0), (1.1 * size, 0.02 * size)])
    borders = [(geometry.edges(geometry.Polygon(corners)), None), (above, layer == 0), (below, layer == 1)]
    return (x, y, r, layer, borders), r


@pytest.mark.parametrize("count, widest, sweeps", [(4000, 3.0, 100), (4000, 60.0, 50), (4000, 1.0, 50)])
def test_sweeps_have_the_same_bits_on_any_number_of_threads(count, widest, sweeps, monkeypatch):
    monkeypatch.setattr(relaxation, "SWEEPS", sweeps)
    given, r = crowd(count, widest)
    oracle = numpy_packing.Relaxer(*given[:2], r.copy(), *given[3:], np.random.default_rng(1))
    oracle.run(sweeps)
    assert np.count_nonzero(oracle.r != r) > 100 or widest == 1  # some have changed places
    for threads in (1, 2, 3):
        disks = relaxation.disks(*given, threads=threads)
        relaxation.relax(disks, packing.TARGET, np.random.default_rng(1))
        assert digest(disks.x, disks.y, disks.r) == digest(oracle.x, oracle.y, oracle.r), threads


def test_forces_are_those_of_numpy_after_every_sweep():
    """Also where disks have changed places, and at walls, which push some that have just come near."""
    given, r = crowd(600, 8.0)
    oracle, dice = numpy_packing.Relaxer(
        *given[:2], r.copy(), *given[3:], np.random.default_rng(1)
    ), np.random.default_rng(1)
    disks, sweep, seen = relaxation.disks(*given), 0, []

    def forces():
        nonlocal sweep
        found = numpy_packing.Relaxer._forces(oracle)
        worst = disks.forces(True)
        assert worst == found[3], sweep
        for own, wanted in zip((disks.force_x, disks.force_y, disks.squeeze), found):
            assert np.array_equal(own, wanted), sweep
        if sweep % numpy_packing.SWAP_EVERY == numpy_packing.SWAP_EVERY - 1:
            stride = int(dice.integers(1, max(2, len(disks) // 50)))
            seen.append(disks.exchange(int(dice.integers(0, 2 * stride)), stride))
        disks.step()
        sweep += 1
        return found

    oracle._forces = forces
    oracle.run(400)
    assert sweep == 400 and sum(seen) > 100


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_close_pairs_are_those_of_the_trees(threads):
    """Of sizes from one to a thousand, of one size on a lattice where all touch, and of few disks."""
    dice = np.random.default_rng(2)
    n = 3000
    wide = (*dice.uniform(0, 300, (2, n)), np.geomspace(0.02, 20, n)[dice.permutation(n)])
    at = np.arange(40) * 1.0
    lattice = (*map(np.ravel, np.meshgrid(at / 3, at / 3)), np.full(1600, 1 / 6))
    for x, y, r in (wide, lattice, tuple(a[:1] for a in wide), tuple(a[:2] for a in lattice)):
        for margin in (0.0, 1e-17, 0.02 * 2 * r.max()):
            own = relaxation._library().close_pairs(x, y, r, margin, threads)
            wanted = numpy_packing.close_pairs(x, y, r, margin)
            assert all(np.array_equal(a, b) for a, b in zip(own, wanted))


def test_walls_push_as_they_did():
    (x, y, r, _, borders), _ = crowd(3000, 20.0)
    table = borders[0][0]
    for margin in (0.0, 0.5):
        disks, walls, *push = relaxation.pushes(x, y, r, margin, table)
        at, edge = numpy_packing.close_edges(x, y, r, margin, table)
        order = np.lexsort((edge, at))
        assert np.array_equal(disks, at[order]) and np.array_equal(walls, edge[order]) and len(disks) > 50
        wanted = numpy_packing.edge_overlaps(x, y, r, at[order], edge[order], table)
        assert np.array_equal(push[0], wanted[0]) and push[0].any()
        for own, other in zip(push[1:], wanted[1:]):
            assert np.array_equal(own[push[0] > 0], other[push[0] > 0])
