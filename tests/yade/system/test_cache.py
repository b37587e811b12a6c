"""The cache: what is kept comes back to the bit, what is damaged is made anew and said to be, what is old can be
cleared. Needs no YADE.
"""

import os
import sys
import threading
import time
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
import leftovers  # noqa: E402
from nonsmooth import errors  # noqa: E402
from nonsmooth.system import cache, whole_files  # noqa: E402

KEY = "0123456789abcdef" * 4  # as SHA-256 writes it
DAY = 86400.0  # s


@dataclass(frozen=True, eq=False)
class Heap:
    """A made-up value: arrays, a number and a whole one."""

    x: np.ndarray
    layer: np.ndarray
    width: float
    count: int


MADE = Heap(np.array([0.1, 1 / 3, -2e-17, -0.0]), np.array([[3, -1]]), 1 / 7, 4)
CACHE = cache.Cache("heaps", Heap)


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    """Where the cache is in a test."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "yade-nonsmooth"


def never():
    raise AssertionError("it is there")


def assert_same(one, other):
    for name, value in vars(other).items():
        found = getattr(one, name)
        assert type(found) is type(value)
        a, b = np.asarray(found), np.asarray(value)
        assert (a.dtype, a.shape, a.tobytes()) == (b.dtype, b.shape, b.tobytes()), name


def aged(path, days):
    os.utime(path, (time.time() - DAY * days,) * 2)


def kept(key=KEY):
    path = CACHE.path(key)
    CACHE.keep(path, MADE)
    return path


# ---- kept and found -------------------------------------------------------------------------------


def test_what_is_kept_comes_back_to_the_bit_and_is_made_once(home):
    path, made = CACHE.path(KEY), []
    assert CACHE.find(path) is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # nothing is said of what is not there, or whole
        assert CACHE.of(path, lambda: made.append(1) or MADE) is MADE
        assert_same(CACHE.of(path, never), MADE)
        assert_same(CACHE.find(path), MADE)
    assert made == [1] and [*home.rglob("*.npz")] == [path]


def test_readers_and_writers_are_the_callers():
    """Here a value is its square's root: what is written is the square, and what is read is its root."""
    roots = cache.Cache("samples", lambda square: np.sqrt(square), lambda root: {"square": root**2})
    path = roots.path(KEY)
    assert roots.of(path, lambda: np.array([2.0, 3.0])).tolist() == [2.0, 3.0]
    assert roots.of(path, never).tolist() == [2.0, 3.0]
    assert np.load(path)["square"].tolist() == [4.0, 9.0]


def test_names_have_the_folder_the_key_and_the_format(home, monkeypatch):
    path = CACHE.path(KEY, "-7-pressed")
    assert path == home / "heaps" / f"{KEY[:32]}-7-pressed-v{cache.FORMAT}.npz"
    others = [CACHE.path(KEY), CACHE.path("f" + KEY[1:], "-7-pressed"), cache.Cache("samples", Heap).path(KEY)]
    assert len({path, *others}) == 4
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert CACHE.path(KEY).parent == Path.home() / ".cache" / "yade-nonsmooth" / "heaps"


def test_other_folders_are_not_the_caches():
    with pytest.raises(
        cache.CacheError, match="^cache 'slim-yade': there is none of this name; give one of packings, "
    ):
        cache.folder("slim-yade")
    with pytest.raises(cache.CacheError, match="slim-yade"):
        cache.clear(0, "slim-yade")


# ---- damaged --------------------------------------------------------------------------------------


def changed(path, **change):
    """Writes an entry again with its checksum and other arrays, as no reader of files could see."""
    with np.load(path) as file:
        stored = {**file, **change}
    whole_files.write_arrays(path, **{name: value for name, value in stored.items() if value is not None})


ONE_ARRAY = (
    b"\x93NUMPY\x01\x00v\x00"
    + b"{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }".ljust(117)
    + b"\n"
    + bytes(8)
)

DAMAGES = {
    "empty": (lambda path: path.write_bytes(b""), ""),
    "cut": (lambda path: path.write_bytes(path.read_bytes()[:-1]), ""),
    "half": (lambda path: path.write_bytes(path.read_bytes()[: path.stat().st_size // 2]), ""),
    "text": (lambda path: path.write_text("no arrays\n"), ""),
    "one array": (lambda path: path.write_bytes(ONE_ARRAY), ""),
    "a_bit": (
        lambda path: changed(path, x=np.where([1, 0, 0, 0], np.nextafter(MADE.x, 1), MADE.x)),
        "does not match its checksum",
    ),
    "a sign": (lambda path: changed(path, x=np.abs(MADE.x)), "does not match its checksum"),
    "a type": (lambda path: changed(path, layer=MADE.layer.view("<u8")), "does not match its checksum"),
    "a shape": (lambda path: changed(path, layer=MADE.layer.T), "does not match its checksum"),
    "a name": (lambda path: changed(path, x=None, y=MADE.x), "does not match its checksum"),
    "one less": (lambda path: changed(path, layer=None), "does not match its checksum"),
    "no checksum": (lambda path: changed(path, checksum=None), "checksum"),
    "no format": (lambda path: changed(path, format=None), "format"),
    "older": (lambda path: changed(path, format=np.int64(cache.FORMAT - 1)), f"format {cache.FORMAT - 1}, this"),
    "newer": (lambda path: changed(path, format=np.int64(cache.FORMAT + 1)), f"format {cache.FORMAT + 1}, this"),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_what_is_damaged_is_made_anew_with_one_note(damage):
    path = kept()
    whole = path.read_bytes()
    spoil, said = DAMAGES[damage]
    spoil(path)
    spoilt = path.read_bytes()
    assert spoilt != whole
    aged(path, 9)
    with pytest.warns(errors.UserNote) as told:
        assert CACHE.find(path) is None
    assert len(told) == 1
    (note,) = (str(one.message) for one in told)
    assert note.startswith(f"{path}: damaged, or of another version (") and note.endswith("; it is made anew")
    assert said in note and "()" not in note and "\n" not in note
    assert path.read_bytes() == spoilt and cache.old(8) == [path]  # it was not used, and is there to be looked at
    with pytest.warns(errors.UserNote):
        assert CACHE.of(path, lambda: MADE) is MADE
    assert path.read_bytes() == whole
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert_same(CACHE.of(path, never), MADE)


def test_an_entry_written_as_before_is_no_damage():
    """What `changed` writes is read where nothing is changed, so that the damages above are those that they say."""
    path = kept()
    changed(path)
    assert_same(CACHE.of(path, never), MADE)


def test_a_mistake_of_the_reader_is_no_damage():
    path = kept()
    with pytest.raises(TypeError, match="argument"):
        cache.Cache("heaps", lambda x: x).of(path, never)


def test_half_written_files_are_no_entries(home):
    """Left by processes that were killed before they renamed them; they go when they are old."""
    path = CACHE.path(KEY)
    whole = kept().read_bytes()
    leftovers.plant(home, f"heaps/{path.name}")
    path.unlink()
    assert len(leftovers.found(home)) == 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert CACHE.find(path) is None and CACHE.of(path, lambda: MADE) is MADE
    assert path.read_bytes() == whole and len(leftovers.found(home)) == 2
    for name in leftovers.found(home):
        aged(home / name, 2)
    assert len(cache.clear(1)) == 2 and leftovers.found(home) == [] and path.exists()


def test_what_cannot_be_made_leaves_nothing_behind(home):
    def fails():
        raise errors.UserError("no room for its disks")

    with pytest.raises(errors.UserError, match="no room"):
        CACHE.of(CACHE.path(KEY), fails)
    assert [*home.rglob("*")] == []


def test_a_cache_that_cannot_be_written_is_one_message(home):
    home.mkdir()
    (home / "heaps").write_text("a file in the place of the folder")
    with pytest.warns(errors.UserNote), pytest.raises(whole_files.WriteError, match="cannot be written"):
        CACHE.of(CACHE.path(KEY), lambda: MADE)


# ---- several makers -------------------------------------------------------------------------------


def test_makers_at_the_same_time_all_get_it_whole(home):
    """Each of four finds none, since the barrier holds them all in the making, and a fifth that reads all the while
    meets none or a whole one.
    """
    path, found, seen, over = CACHE.path(KEY), [], [], threading.Event()
    together = threading.Barrier(4, timeout=60)

    def make():
        together.wait()
        return MADE

    def read():
        while not over.is_set():
            if (one := CACHE.find(path)) is not None:
                seen.append(one)

    with warnings.catch_warnings():
        warnings.simplefilter("error")  # which ends the reader that meets half a file
        reader = threading.Thread(target=read)
        makers = [threading.Thread(target=lambda: found.append(CACHE.of(path, make))) for _ in range(4)]
        for one in (reader, *makers):
            one.start()
        for one in makers:
            one.join()
        while not seen and reader.is_alive():
            time.sleep(0.001)
        over.set()
        reader.join()
    assert len(found) == 4 and seen
    for one in (*found, *seen, CACHE.of(path, never)):
        assert_same(one, MADE)
    assert [one.name for one in path.parent.iterdir()] == [path.name]


# ---- age ------------------------------------------------------------------------------------------


def test_the_age_counts_from_the_last_use():
    path, other = kept(), kept("f" + KEY[1:])
    for one in (path, other):
        aged(one, 11)
    assert cache.old(10) == sorted((path, other)) and cache.old(12) == []
    CACHE.of(path, never)
    assert cache.old(10) == [other] and cache.old(0, "samples") == []
    assert CACHE.find(other) is not None and cache.old(10) == []


def test_what_is_old_goes_and_all_else_stays(home):
    """Files and folders of the cache's four alone: the set-up's sources and builds are older, and stay."""
    for name in (*cache.FOLDERS, "slim-yade"):
        for age in (9, 11):
            (home / name / f"{age}" / "scene").mkdir(parents=True)
            (home / name / f"{age}.npz").write_text("")
            aged(home / name / f"{age}", age)
            aged(home / name / f"{age}.npz", age)
    outside = home.parent / "elsewhere"
    outside.mkdir()
    (outside / "scene").write_text("")
    (home / "heaps" / "link").symlink_to(outside)
    aged(outside, 11)
    gone = cache.clear(10, "benchmark")
    assert gone == [home / "benchmark" / "11", home / "benchmark" / "11.npz"] and not any(map(os.path.lexists, gone))
    assert len(cache.clear(10)) == 7  # two in each of the other three, and the link
    assert (outside / "scene").exists() and not os.path.lexists(home / "heaps" / "link")
    left = sorted(path.relative_to(home).as_posix() for path in home.glob("*/*"))
    assert left == sorted(
        [
            *(f"{name}/{one}" for name in cache.FOLDERS for one in ("9", "9.npz")),
            *(f"slim-yade/{one}" for one in ("11", "11.npz", "9", "9.npz")),
        ]
    )
    assert cache.clear(10) == []


def test_what_cannot_go_is_not_said_to_have_gone(monkeypatch):
    path = kept()
    aged(path, 2)
    monkeypatch.setattr(cache.Path, "unlink", lambda *_: (_ for _ in ()).throw(PermissionError()))
    assert cache.clear(1) == [] and path.exists()


def test_a_folder_is_used_too_and_what_is_not_there_is_no_matter(home):
    state = cache.folder("benchmark") / "a"
    state.mkdir(parents=True)
    aged(state, 3)
    cache.used(state)
    assert cache.old(2) == []
    cache.used(state / "none")


@pytest.mark.parametrize("days", [-1, float("nan"), float("inf"), "10", True, None])
def test_an_age_that_is_none_is_refused(days):
    with pytest.raises(cache.CacheError, match="^days .*: give the days without use"):
        cache.clear(days)
