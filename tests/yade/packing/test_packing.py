"""Packings: density, sizes, overlaps and places; files that are truncated, changed or wrong."""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import packing, similar  # noqa: E402
from nonsmooth.errors import UserNote  # noqa: E402
from nonsmooth.model import free_surface, geometry  # noqa: E402
from nonsmooth.packing import Packing, PackingError, checks as packing_checks, relaxation  # noqa: E402
from nonsmooth.section import FOLDER, load  # noqa: E402
from nonsmooth.system.whole_files import WriteError  # noqa: E402


@pytest.fixture(scope="module")
def section():
    return dataclasses.replace(load("jiufengershan"), pressed=False).with_disks(3000)


@pytest.fixture(scope="module")
def shares():
    return []


@pytest.fixture(scope="module")
def packed(section, shares):
    return packing.pack(section, 1, shares.append)


def test_is_dense_without_overlap(section, packed):
    assert len(packed) == pytest.approx(3000, abs=2)
    found = packing.overlaps(packed, section.outline)
    assert found.worst <= 1e-3 and found.mean <= 1e-5
    assert found.pairs > 1.5 * len(packed)
    assert packing.packing_fraction(packed, section.outline) == pytest.approx(section.disks.packing_fraction, abs=0.01)


def test_is_even_along_the_slope(section, packed):
    along = -(packed.x * section.downslope[0] + packed.y * section.downslope[1])
    for s in range(100, 1400, 100):
        here = (along >= s) & (along < s + 100)
        thickness = 65 - 23 * (s + 50) / 1458
        assert np.sum(math.pi * packed.r[here] ** 2) / (100 * thickness) == pytest.approx(0.83, abs=0.05)


def test_disks_are_inside_and_near_their_layer(section, packed):
    depth = np.full(len(packed), np.inf)
    table = geometry.edges(section.outline)
    for start, normal in zip(table.start, table.normal):  # the outline is convex
        depth = np.minimum(depth, (packed.x - start[0]) * normal[0] + (packed.y - start[1]) * normal[1])
    assert np.all(depth >= packed.r * (1 - 1e-3))
    away = [
        section.layers[k].polygon.distance(geometry.Point(x, y)) for x, y, k in zip(packed.x, packed.y, packed.layer)
    ]
    assert np.mean(np.array(away) > 2 * packed.r.mean()) < 0.02
    assert np.max(away) < section.disks.d_max


def test_sizes_are_uniform_by_volume(section, packed):
    d = 2 * packed.r
    lo, hi = section.disks.d_min, section.disks.d_max
    assert lo * (1 - 1e-9) <= d.min() and d.max() <= hi * (1 + 1e-9)
    area, _ = np.histogram(d, np.linspace(lo, hi, 6), weights=d**2)
    assert area / area.sum() == pytest.approx(np.full(5, 0.2), abs=0.01)
    for k in range(5):  # and so in each layer
        area, _ = np.histogram(d[packed.layer == k], np.linspace(lo, hi, 4), weights=d[packed.layer == k] ** 2)
        assert area / area.sum() == pytest.approx(np.full(3, 1 / 3), abs=0.05)


def test_progress(packed, shares):
    assert shares == sorted(shares) and shares[-1] == 1 and 0 <= shares[0] < 1


@pytest.mark.parametrize(
    "worst, share", [(2.0, 0.0), (math.sqrt(2 * packing.TARGET), 0.5), (0.5 * packing.TARGET, 0.99), (3.0, 0.0)]
)
def test_a_packing_is_as_far_as_its_worst_overlap_has_fallen(worst, share):
    """In powers of ten from two diameters, disks at one place, to the target; the end is told by who packs."""
    told = []

    class Stop(Exception):
        pass

    def stop(found):
        told.append(found)
        raise Stop

    class Disks:
        def __len__(self):
            return 2

        def forces(self, squeezes):
            return worst

    with pytest.raises(Stop):
        relaxation.relax(Disks(), packing.TARGET, None, stop)
    assert told == [pytest.approx(share, abs=1e-12)]  # rounding


@pytest.fixture(scope="module")
def small():
    """A looser packing in a bent region with a reflex corner, quick to make."""
    data = yaml.safe_load((FOLDER / "jiufengershan.yaml").read_text(encoding="utf-8"))
    del data["water"]
    data["disks"] = {"diameter": [0.5, 1.5], "packing_fraction": 0.8}
    data["walls"] = [{"name": "floor", "material": "ss", "vertices": [[-30, 20], [0, 0], [30, 5]]}]
    data["layers"] = [
        {"name": "a", "material": "rock", "vertices": [[-24, 16], [0, 0], [0, 10], [-20, 30]]},
        {"name": "b", "material": "rock", "vertices": [[0, 0], [24, 4], [24, 16], [0, 10]]},
    ]
    return data


@pytest.fixture
def bent(small, tmp_path):
    path = tmp_path / "bent.yaml"
    path.write_text(yaml.safe_dump(small))
    return load(path)


def test_same_seed_same_bits_in_a_bent_region(bent):
    one, two, other = (packing.pack(bent, seed) for seed in (3, 3, 4))
    assert one.checksum == two.checksum != other.checksum
    assert packing.overlaps(one, bent.outline).worst <= 1e-3
    x, y, r = one.x, one.y, one.r
    assert all(bent.outline.contains(geometry.Point(*p)) for p in zip(x, y))
    assert all(bent.outline.boundary.distance(geometry.Point(a, b)) >= c * 0.999 for a, b, c in zip(x, y, r))
    assert packing.packing_fraction(one, bent.outline) == pytest.approx(0.8, abs=0.03)


def test_too_dense(bent, monkeypatch):
    monkeypatch.setattr(relaxation, "SWEEPS", 300)
    dense = dataclasses.replace(bent, disks=dataclasses.replace(bent.disks, packing_fraction=0.95))
    with pytest.raises(PackingError, match="lower disks.packing_fraction"):
        packing.pack(dense, 1)


def test_cache(bent, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path = packing.cache_path(bent, 3)
    assert path.parent == tmp_path / "cache" / "yade-nonsmooth" / "packings"
    made = packing.cached_pack(bent, 3)
    assert [p.name for p in path.parent.iterdir()] == [path.name]
    with monkeypatch.context() as kept:
        kept.setattr(packing, "pack", None)
        assert packing.cached_pack(bent, 3).checksum == made.checksum
    whole = path.read_bytes()
    path.write_bytes(whole[:-400])
    with pytest.warns(UserNote, match="made anew"):
        assert packing.cached_pack(bent, 3).checksum == made.checksum
    assert path.read_bytes() == whole
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert packing.cache_path(bent, 3).parent == Path.home() / ".cache" / "yade-nonsmooth" / "packings"


@pytest.fixture
def three():
    return Packing([0.0, 1 / 3, -2e-17], [0.1, 1.0, 2.0], [0.5, 0.25, 1e-3], [0, 1, 1])


def test_npz(three, tmp_path):
    path = tmp_path / "deep" / "p.npz"
    packing.save(three, path)
    assert packing.load(path).checksum == three.checksum
    whole = path.read_bytes()
    for cut in (0, 10, len(whole) // 2, len(whole) - 1):
        path.write_bytes(whole[:cut])
        with pytest.raises(PackingError, match="delete the file"):
            packing.load(path)
    with pytest.raises(PackingError, match="no such packing"):
        packing.load(tmp_path / "none.npz")
    np.savez(
        path, x=three.x + 1, y=three.y, r=three.r, layer=three.layer, format=packing.FORMAT, checksum=three.checksum
    )
    with pytest.raises(PackingError, match="does not match its checksum.*delete the file"):
        packing.load(path)
    np.savez(path, x=three.x, y=three.y, r=three.r, layer=three.layer, format=99, checksum=three.checksum)
    with pytest.raises(PackingError, match="format 99"):
        packing.load(path)
    np.savez(path, x=three.x)
    with pytest.raises(PackingError, match="delete the file"):
        packing.load(path)
    with pytest.raises(PackingError, match=r"deep: cannot be read \(Is a directory\); make it readable, or delete it"):
        packing.load(path.parent)


def test_cannot_be_written(three, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(WriteError, match="cannot be written"):
        packing.save(three, tmp_path / "file" / "p.npz")
    (tmp_path / "p.npz").mkdir()
    with pytest.raises(WriteError, match="cannot be written"):
        packing.save(three, tmp_path / "p.npz")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["file", "p.npz"]


def test_text(three, tmp_path):
    path = tmp_path / "p.txt"
    packing.write_text(three, path)
    assert packing.read_text(path).checksum == three.checksum
    path.write_text("# by hand\n\n 0 1 0.5 # a disk\n2 3 .25\n")
    read = packing.read_text(path)
    assert read.r.tolist() == [0.5, 0.25] and read.layer.tolist() == [0, 0]


@pytest.mark.parametrize(
    "text, what",
    [
        ("0 0 1 0\n1 1\n", r"line 2: 2 values"),
        ("0 0 1 0\n1 1 1\n", r"line 2: 3 values after lines of 4.*truncated"),
        ("0 0 -1\n", r"line 1: the radius is -1"),
        ("0 nan 1\n", r"line 1: y is nan"),
        ("0 0 one\n", r"line 1: .*'one'"),
        ("0 0 1 0.5\n", r"line 1: .*whole"),
        ("0 0 1 -1\n", r"line 1: the layer is -1"),
        ("# nothing\n", "holds no disk"),
        ("# disks: 3\n0 0 1 0\n", "holds 1 disks of the 3.*truncated"),
        (
            "# disks: 1\n0 0 1 0\n9 9 1 0\n",
            "holds 2 disks, 1 more than the 1 it announces; take out the lines .*# disks: 1'$",
        ),
        ("1e308 0 1\n", r"line 1: x is 1e\+308; give m, at most 1e\+07"),
        ("0 0 5e-324\n", "line 1: the radius is"),
        ("0 0 1 " + "9" * 30 + "\n", "line 1: the layer is 9999"),
        ("0 0 1 " + "9" * 5000 + "\n", "line 1: .*whole one"),
        ("0 0 " + "x" * 5000 + "\n", "line 1: .{0,90}; give numbers"),
    ],
)
def test_bad_text(text, what, tmp_path):
    path = tmp_path / "p.txt"
    path.write_text(text)
    with pytest.raises(PackingError, match=what) as info:
        packing.read_text(path)
    assert str(path) in str(info.value)


def test_unreadable_text(tmp_path):
    with pytest.raises(PackingError, match="cannot be read"):
        packing.read_text(tmp_path / "none.txt")
    with pytest.raises(PackingError, match="has no end"):
        packing.read_text("/dev/zero")
    (tmp_path / "b").write_bytes(b"\xff\x00")
    with pytest.raises(PackingError, match="is no text"):
        packing.read_text(tmp_path / "b")


def moved(packing, **arrays):
    return dataclasses.replace(packing, **arrays)


def inner(packing):
    """Number of the disk nearest to the middle of all."""
    return int(np.argmin((packing.x - packing.x.mean()) ** 2 + (packing.y - packing.y.mean()) ** 2))


def first_to(packing, x, y):
    """The packing with its first disk elsewhere."""
    return moved(packing, x=np.r_[x, packing.x[1:]], y=np.r_[y, packing.y[1:]])


# What the shipped section with 3,000 disks (2.6 to 10.6 m) says of a file that is none of its packings.
FOREIGN = {
    "all radii times 1.3": (lambda p: moved(p, r=1.3 * p.r), "has a radius of .* and the section's disks have"),
    "nearly all radii times 1.3": (
        lambda p: moved(p, r=np.minimum(1.3 * p.r, p.r.max())),
        "lies in the wall|overlap by up to",
    ),
    "loose": (
        lambda p: moved(p, r=np.maximum(0.8 * p.r, p.r.min())),
        r"disks fill 0\.\d+ of the layers, and the section's fill 0\.8.*disks.packing_fraction",
    ),
    "half of them": (lambda p: Packing(p.x[::2], p.y[::2], p.r[::2], p.layer[::2]), r"disks fill 0\.\d+ of the layers"),
    "another number of disks": (
        lambda p: packing.pack(load("jiufengershan").with_disks(800), 1),
        "has a radius of .* or --disks with its number",
    ),
    "without layers": (
        lambda p: moved(p, layer=0 * p.layer),
        r"belongs to layer 0 \(L1\) and lies .* m outside it; give lines of x y r layer",
    ),
    "layers from 1": (
        lambda p: moved(p, layer=p.layer + 1),
        r"belongs to layer 5, and the section has 5; give 0 \(L1\) to 4 \(L5\)",
    ),
    "layers turned round": (lambda p: moved(p, layer=4 - p.layer), r"belongs to layer 0 \(L1\) and lies"),
    "a layer left out": (
        lambda p: moved(p, layer=np.maximum(p.layer, 1)),
        "no disk belongs to layer 0|belongs to layer 1",
    ),
    "all moved up": (lambda p: moved(p, y=p.y + 300), "outside the layers"),
    "all sunk by a metre": (lambda p: moved(p, y=p.y - 1), "in the wall DP|beyond the wall DP"),
    "one below the slope": (lambda p: first_to(p, -700.0, 255.0), "beyond the wall DP"),
    "one far below the slope": (
        lambda p: first_to(p, -700.0, 0.0),
        "disk 0 at .* lies .* the wall DP|disk 0 at .* outside the layers",
    ),
    "one in the valley": (lambda p: first_to(p, 1000.0, 40.0), "disk 0 at .* outside the layers"),
    "one far away": (lambda p: first_to(p, 1e7, -1e7), "disk 0 at .* outside the layers"),
    "one above the slope": (lambda p: first_to(p, -700.0, 500.0), "disk 0 at .* lies .* m outside the layers"),
    "one twice": (lambda p: first_to(p, p.x[inner(p)], p.y[inner(p)]), "overlap by more than a tenth|belongs to layer"),
    "all at one place": (
        lambda p: moved(p, x=0 * p.x + p.x[inner(p)], y=0 * p.y + p.y[inner(p)], layer=p.layer),
        "overlap by more than a tenth|belongs to layer",
    ),
}


@pytest.mark.parametrize("case", FOREIGN)
def test_packing_of_another_section(case, section, packed):
    change, what = FOREIGN[case]
    with pytest.raises(PackingError, match=what) as info:
        packing_checks.check(change(packed), section, "p.txt")
    assert str(info.value).startswith("p.txt: ") and "\n" not in str(info.value)


def test_disks_that_overlap_are_told_by_how_much(section, packed):
    """One disk is brought nearer to its neighbour, by 5 % of their mean diameter; or all but the largest have grown by
    0.4 %, so that no pair is bad and their mean is.
    """
    k = inner(packed)
    near = np.hypot(packed.x - packed.x[k], packed.y - packed.y[k]) - packed.r - packed.r[k]
    near[(packed.layer != packed.layer[k]) | (np.arange(len(packed)) == k)] = np.inf
    other = int(np.argmin(near))
    way = np.array([packed.x[other] - packed.x[k], packed.y[other] - packed.y[k]])
    share = 1 - 0.95 * (packed.r[k] + packed.r[other]) / np.hypot(*way)
    x, y = packed.x.copy(), packed.y.copy()
    x[k], y[k] = x[k] + share * way[0], y[k] + share * way[1]
    with pytest.raises(
        PackingError,
        match="^p.txt: disks overlap by up to 0.05[0-9]* of their mean diameter, .* at most 0.02, and 0.001 in the mean",
    ):
        packing_checks.check(moved(packed, x=x, y=y), section, "p.txt")
    grown = moved(packed, r=np.minimum(1.004 * packed.r, packed.r.max()))
    with pytest.raises(PackingError, match=r"disks overlap by up to 0\.00\d+ of their mean diameter, 0\.00[1-4]"):
        packing_checks.check(grown, section, "p.txt")


def test_packings_of_the_section_are_taken(section, packed, bent):
    packing_checks.check(packed, section, "p.txt")
    packing_checks.check(packing.pack(section, 2), section, "p.txt")
    packing_checks.check(packing.pack(bent, 3), bent, "p.txt")
    # as printed with four digits, and settled by a little
    packing_checks.check(moved(packed, x=np.round(packed.x, 2), y=np.round(packed.y, 2)), section, "p.txt")
    packing_checks.check(moved(packed, x=0.9999 * packed.x, y=0.9999 * packed.y), section, "p.txt")


def test_a_layer_of_a_handful_of_disks_is_named():
    """Twenty-nine are too few, thirty are not; an obstacle may have one, and a layer without any is told too."""
    three = load("interface")
    names = [layer.name for layer in three.layers]
    counts = {"stable": 30, "slab": 29, "house": 1}
    layer = np.repeat([names.index(name) for name in counts], list(counts.values()))
    told = packing_checks.sparse_layers(Packing(layer * 1.0, layer * 1.0, layer + 1.0, layer), three)
    assert [sentence.split(":")[0] for sentence in told] == ["LAYER slab HOLDS 29 DISKS", "LAYER bed HOLDS 0 DISKS"]


def test_bad_arrays():
    with pytest.raises(PackingError, match="differ in length"):
        Packing([0.0], [0.0, 1.0], [1.0], [0])
    with pytest.raises(PackingError, match="disk 1: x is inf"):
        Packing([0.0, np.inf], [0.0, 1.0], [1.0, 1.0], [0, 0])
    for r in (0.0, -1.0):
        with pytest.raises(PackingError, match=f"^disk 1: the radius is {r:g} m; give one above 0$"):
            Packing([0.0, 3.0], [0.0, 1.0], [1.0, r], [0, 0])


def test_packing_fraction_of_a_known_lattice():
    n = 40
    i, j = np.meshgrid(np.arange(n), np.arange(n))
    square = Packing(i.ravel() + 0.5, j.ravel() + 0.5, np.full(n * n, 0.5), np.zeros(n * n))
    box = [(0, 0), (n, 0), (n, n), (0, n)]
    assert packing.packing_fraction(square, box) == pytest.approx(math.pi / 4, abs=2e-4)
    assert packing.packing_fraction(square, box, 1.3) == pytest.approx(math.pi / 4, abs=0.01)
    with pytest.raises(PackingError, match="smaller margin"):
        packing.packing_fraction(square, box, 30)
    assert packing.packing_fraction(square, [(0, 0), (n, 0), (n, 1.9), (0, 1.9)]) is None  # no two disks thick


# ---- the parts of packing, by hand ------------------------------------------------------------------


def test_overlaps_by_hand():
    """A pair with a tenth of its mean diameter in common, one with a gap of 1 % that counts as none, and one of 3 %
    that does not count at all.
    """
    rows = Packing([0.0, 1.8, 6.0, 8.02, 12.0, 14.06], [0.0] * 6, [1.0] * 6, [0] * 6)
    found = packing.overlaps(rows)
    assert (found.worst, found.mean, found.pairs) == (pytest.approx(0.1, rel=1e-9), pytest.approx(0.05, rel=1e-9), 2)
    box = geometry.Polygon([(-0.6, -5), (20, -5), (20, 5), (-0.6, 5)])  # 0.4 of a radius of 1 m are out: 0.2 diameters
    assert packing.overlaps(rows, box).worst == pytest.approx(0.2, rel=1e-9)
    alone = packing.overlaps(Packing([0.0, 9.0], [0.0, 0.0], [1.0, 1.0], [0, 0]))
    assert (alone.worst, alone.mean, alone.pairs) == (0.0, 0.0, 0)


def test_close_pairs_are_all_that_there_are():
    """Disks of 0.1 to 4 m, six classes of size: each pair once, in order, as all against all finds them."""
    rng = np.random.default_rng(3)
    n = 150
    x, y, r = rng.uniform(0, 40, n), rng.uniform(0, 40, n), np.geomspace(0.1, 4.0, n)[rng.permutation(n)]
    for margin in (0.0, 0.5):
        i, j = relaxation.close_pairs(x, y, r, margin)
        a, b = np.triu_indices(n, 1)
        near = np.hypot(x[a] - x[b], y[a] - y[b]) < r[a] + r[b] + margin
        assert list(zip(i, j)) == list(zip(a[near], b[near])) and len(i) > 100


CORNER = [(0, 0), (10, 0), (10, 5), (5, 5), (5, 10), (0, 10)]  # the corner at (5, 5) points into the region


@pytest.mark.parametrize(
    "place, radius, pushes",
    [
        ((2.0, 0.3), 0.5, [(0.2, 0.0, 1.0)]),
        ((7.0, 4.9), 0.5, [(0.4, 0.0, -1.0)]),
        ((2.0, 0.6), 0.5, []),
        ((0.2, 0.3), 0.5, [(0.2, 0.0, 1.0), (0.3, 1.0, 0.0)]),
        ((-0.1, 0.3), 0.5, [(0.2, 0.0, 1.0), (0.6, 1.0, 0.0)]),  # out, beside a corner: the edges go on as lines
        ((4.7, 4.6), 0.6, [(0.1, -0.6, -0.8)]),  # the corner itself, once, from 0.5 m
        ((4.7, 5.2), 0.5, [(0.2, -1.0, 0.0)]),  # beside the end of the edge above, where the corner does not act
        ((4.0, 4.0), 0.5, []),
    ],
)
def test_edges_and_corners_push_by_hand(place, radius, pushes):
    table = geometry.edges(geometry.Polygon(CORNER))
    x, y, r = (np.array([v]) for v in (*place, radius))
    _, _, overlap, nx, ny = relaxation.pushes(x, y, r, 0.0, table)
    found = sorted((o, a, b) for o, a, b in zip(overlap, nx, ny) if o > 1e-12)
    assert len(found) == len(pushes)
    for one, wanted in zip(found, sorted(pushes)):
        assert one == pytest.approx(wanted, abs=1e-12)


def test_edges_are_near_with_a_margin():
    table = geometry.edges(geometry.Polygon(CORNER))
    one = np.array([2.0]), np.array([1.0]), np.array([0.5])
    assert len(relaxation.pushes(*one, 0.4, table)[0]) == 0
    disks, walls, *_ = relaxation.pushes(*one, 0.6, table)
    assert disks.tolist() == [0] and table.normal[walls[0]] == pytest.approx((0, 1))
    away = np.array([2.0]), np.array([-0.7]), np.array([0.5])  # out by more than a radius
    assert len(relaxation.pushes(*away, 0.1, table)[0]) == 0 < len(relaxation.pushes(*away, 0.3, table)[0])


def test_a_box_lies_along_the_longest_edge():
    """A rectangle of 6 m by 2 m, turned by 30°, with its corner at (1, 2)."""
    t, n = np.array([math.cos(math.pi / 6), 0.5]), np.array([-0.5, math.cos(math.pi / 6)])
    at = np.array([1.0, 2.0])
    corner, u, v, size = packing._box(geometry.Polygon([at, at + 6 * t, at + 6 * t + 2 * n, at + 2 * n]))
    assert size == pytest.approx(12.0, rel=1e-9)
    found = sorted(map(tuple, (corner, corner + u, corner + v, corner + u + v)))
    for one, wanted in zip(found, sorted(map(tuple, (at, at + 6 * t, at + 2 * n, at + 6 * t + 2 * n)))):
        assert one == pytest.approx(wanted, abs=1e-12)


def test_disks_are_drawn_one_from_each_part_of_the_sizes(bent):
    """Of n disks of a layer the k-th in size lies in the k-th n-th of the distribution; all of them begin within their
    layer.
    """
    x, y, r, layer = packing._draw(bent, np.random.default_rng(7))
    assert np.bincount(layer).tolist() == list(bent.disk_counts())
    for k, one in enumerate(bent.layers):
        own = np.sort(2 * r[layer == k])
        n = len(own)
        low, high = (bent.disks_of(one).diameters(np.arange(m, n + m) / n) for m in (0, 1))
        assert np.all(own >= low * (1 - 1e-12)) and np.all(own <= high * (1 + 1e-12))
        assert all(one.polygon.contains(geometry.Point(p)) for p in zip(x[layer == k], y[layer == k]))


def test_forces_of_overlapping_disks_by_hand(bent):
    """Two disks 0.2 m into each other along (0.6, 0.8), the first one 0.1 m into the floor: unit stiffness between
    disks, two at walls.
    """
    box = geometry.edges(geometry.Polygon([(-9, 0), (9, 0), (9, 9), (-9, 9)]))
    x, y, r = np.array([0.0, 1.08, 5.0]), np.array([0.9, 2.34, 5.0]), np.ones(3)
    one = relaxation.disks(x, y, r, np.zeros(3, int), [(box, None)])
    assert one.forces(True) == pytest.approx(0.2, abs=1e-12)  # of the mean diameter of 2 m
    assert one.force_x == pytest.approx([-0.12, 0.12, 0], abs=1e-12)
    assert one.force_y == pytest.approx([-0.16 + 0.2, 0.16, 0], abs=1e-12)
    assert one.squeeze == pytest.approx([0.2 + 0.2, 0.2, 0], abs=1e-12)
    # an edge that acts on other disks does not push this one
    other = relaxation.disks(x, y, r, np.zeros(3, int), [(box, np.array([False, True, True]))])
    other.forces(True)
    assert other.force_y == pytest.approx([-0.16, 0.16, 0], abs=1e-12)


def test_disks_move_alike_along_both_axes(monkeypatch):
    """Twenty disks in a square, which are moved as far as twenty sweeps do it, and the same with x for y."""
    dice = np.random.default_rng(4)
    x, y = dice.uniform(1.0, 9.0, (2, 20))
    r, table = dice.uniform(0.7, 1.3, 20), geometry.edges(geometry.Polygon([(0, 0), (10, 0), (10, 10), (0, 10)]))
    monkeypatch.setattr(relaxation, "SWEEPS", 20)
    found = []
    for places in ((x, y), (y, x)):
        one = relaxation.disks(*places, r, np.zeros(20, int), [(table, None)])
        relaxation.relax(one, packing.TARGET, np.random.default_rng(1))
        found.append((one.x, one.y))
    assert np.hypot(found[0][0] - x, found[0][1] - y).max() > 0.3
    assert found[0][0] == pytest.approx(found[1][1], abs=1e-9) and found[0][1] == pytest.approx(found[1][0], abs=1e-9)


@pytest.mark.parametrize(
    "overlap, layer, changed", [(0.6, (0, 0), True), (0.4, (0, 0), False), (0.6, (0, 1), False), (-0.6, (0, 0), False)]
)
def test_the_more_squeezed_larger_one_changes_places(overlap, layer, changed):
    """Radii 1 and 1.5 m, the larger one (where the overlap is negative the smaller one) that far in the floor of a box,
    which counts twice: they change places where it is squeezed by more than it is larger, in one layer alone.
    """
    box, by = geometry.edges(geometry.Polygon([(-9, 0), (9, 0), (9, 99), (-9, 99)])), 0.5 * abs(overlap)
    at = (9.0, 1.5 - by) if overlap > 0 else (1.0 - by, 9.0)
    one = relaxation.disks(np.array([-4.0, 4.0]), np.array(at), np.array([1.0, 1.5]), np.array(layer), [(box, None)])
    assert one.forces(True) == pytest.approx(by / (3.0 if overlap > 0 else 2.0), abs=1e-12)  # of its diameter
    assert one.squeeze == pytest.approx([0, overlap] if overlap > 0 else [-overlap, 0], abs=1e-12)
    assert one.exchange(0, 1) == changed
    assert one.r.tolist() == ([1.5, 1.0] if changed else [1.0, 1.5])


def test_every_other_stretch_of_sizes_is_compared():
    """Eight disks, from 1 to 1.07 m, the larger ones in the floor: from the second place on, and two places apart."""
    box = geometry.edges(geometry.Polygon([(-99, 0), (99, 0), (99, 99), (-99, 99)]))
    r = 1 + 0.01 * np.arange(8)
    one = relaxation.disks(10.0 * np.arange(8), r - 0.1 * np.arange(8), r, np.zeros(8, int), [(box, None)])
    one.forces(True)
    assert one.exchange(1, 2) == 3  # places 1 and 3, 2 and 4, 5 and 7
    assert one.r.tolist() == r[[0, 3, 4, 1, 2, 7, 6, 5]].tolist()


def test_mirrored_and_similar_sections_have_the_mirrored_and_similar_disks(bent):
    made = packing.pack(bent, 3)
    other = packing.pack(similar.mirrored(bent), 3)
    left, right = (packing.pack(s, 3) for s in (bent, similar.mirrored(bent)))
    assert np.array_equal(other.x, -made.x) and np.array_equal(other.y, made.y) and np.array_equal(other.r, made.r)
    assert left.checksum == made.checksum and right.checksum == other.checksum
    large = packing.pack(similar.scaled(bent, 4.0), 3)
    assert np.array_equal(large.x, 4 * made.x) and np.array_equal(large.r, 4 * made.r)
    # without a seed that of the section counts, of the one that it is like as well
    own = dataclasses.replace(bent, seed=3)
    assert packing.pack(own).checksum == made.checksum
    assert np.array_equal(packing.pack(similar.scaled(own, 4.0)).x, large.x)


def test_disks_do_not_cross_a_flat_interface():
    """A flat interface is a wall for the disks on either side: none reaches over it by more than a thousandth of its
    diameter.
    """
    three = dataclasses.replace(load("interface"), pressed=False).with_disks(1500)
    made = packing.pack(three, 1)
    flat = [interface for interface in three.interfaces if interface.flat]
    assert flat
    for interface in flat:
        above = geometry.sides(three.line_of(interface))[0]
        for number, side in zip(three.numbers_of(interface), (-1, 1)):
            own = made.layer == number
            places = np.column_stack((made.x, made.y))[own]
            away, way, which = geometry.nearest(
                places, above.start, above.start + above.length[:, None] * above.direction
            )
            high = side * np.sum(way * above.normal[which], axis=1)
            beside = np.isclose(np.abs(high), away, rtol=1e-6)  # not beyond the line's ends
            assert np.all(high[beside] >= made.r[own][beside] * (1 - 2e-3)) and beside.any()


def test_a_flat_interface_bounds_the_disks_on_either_side():
    """Its upper side holds those of the layer above, its lower side those below; raised by the share that pressing
    takes, it is a little higher. One that is not flat bounds none.
    """
    three = dataclasses.replace(load("interface"), pressed=False)
    layer = np.arange(len(three.layers))
    ((lower, upper),) = (three.numbers_of(i) for i in three.interfaces)
    assert (three.layers[lower].name, three.layers[upper].name) == ("stable", "slab")
    (whole, every), (above, up), (below, down) = packing._borders(three, layer)
    assert every is None and (layer[up].tolist(), layer[down].tolist()) == ([upper], [lower])
    assert len(whole.length) == len(geometry.edges(three.outline).length)
    assert np.all(above.normal[:, 1] > 0) and np.all(below.normal[:, 1] < 0)
    pressed = packing._borders(dataclasses.replace(three, pressed=True), layer)[1][0]
    rise = np.sum((pressed.start - above.start) * above.normal, axis=1)
    # of the stable layer's thickness, 16 m upwards on a slope of 152.869 in 420; vertices have three digits
    thickness = 16 * math.cos(math.atan2(152.869, 420))
    assert rise == pytest.approx(free_surface.PRESSED * thickness, rel=5e-4)
    rough = dataclasses.replace(three, interfaces=[dataclasses.replace(three.interfaces[0], flat=False)])
    assert len(packing._borders(rough, layer)) == 1
