"""Checkpoints: the scene beside a small JSON file that names it; the earlier one stays until the new one is whole.

What a resume reads has a checksum, and is compared with it before anything is loaded: YADE ends its process over some
damaged scenes, and takes others.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import mmap
import os
from pathlib import Path

from ..system.keys import engines_key, key_of
from ..system.whole_files import WriteError, remove_parts, sync_folder, whole, write_atomically, write_json

__all__ = ["exists", "forget", "read", "write"]

FORMAT = 2
# keys of the JSON file that are not the caller's
OWN = ("format", "scene", "size", "sha256", "step", "key", "engines", "sum")


def exists(folder):
    """Whether there is a checkpoint in ``folder``."""
    return _named(folder).exists()


def forget(folder):
    """Removes the checkpoint in ``folder``, if there is one: for a run that begins anew, before it writes anything.
    Raises WriteError.
    """
    path = _named(folder)
    try:
        if path.parent.is_dir():
            path.unlink(missing_ok=True)  # first, as the others mean nothing without it
            sync_folder(path.parent)
            for scene in whole(path.parent, "scene-*.yade*"):
                scene.unlink()
    except OSError as error:
        raise WriteError(
            f"{path.parent}: the checkpoint of an earlier run cannot be removed ({error.strerror}); remove it, or give another folder"
        ) from None
    remove_parts(path.parent)


def write(folder, key, content):
    """Saves the scene and ``content`` (what JSON can hold, no NaN) below ``folder``. Raises WriteError."""
    from yade import O

    folder = _named(folder).parent
    with _saved(folder) as scene:
        whole_sum = hashlib.sha256(scene).hexdigest()
        # named by its content too: a second checkpoint of one step must not take the place of what the first names
        name, size = f"scene-{O.iter:08d}-{whole_sum[:8]}.yade", len(scene)
        write_atomically(folder / name, scene)
    head = {
        "format": FORMAT,
        "scene": name,
        "size": size,
        "sha256": whole_sum,
        "step": O.iter,
        "key": key,
        "engines": _engines(),
    }
    told = {**content, **head}
    write_json(folder / "checkpoint.json", {**told, "sum": key_of(told)}, allow_nan=False)
    for old in whole(folder, "scene-*.yade*"):
        if old.name != name:
            old.unlink(missing_ok=True)


def read(folder, key, error, again="run without --resume"):
    """Loads the scene of the checkpoint below ``folder`` and returns the content that :func:`write` was given.

    Raises ``error`` (an exception class) where there is none, where it is damaged, or where its key is another than
    ``key``; the scene is then as it was.
    ``again``: how a run is begun anew, for its message.
    """
    from yade import O

    path = _named(folder)
    anew = f"remove {path.parent} and {again}"
    told = _told(path, again, anew, error)
    if told.get("format") != FORMAT or told["engines"] != _engines():
        raise error(
            f"{path}: another version of the plugin or of YADE wrote this checkpoint, and would not go on with the same bits; resume with that one, or {anew}"
        )
    if told["key"] != key:
        raise error(
            f"{path}: this checkpoint belongs to other settings (input, number of disks or seed); give the same ones, or another --out"
        )
    scene = path.parent / told["scene"]
    try:
        found = scene.read_bytes()
    except OSError as problem:
        raise error(
            f"{scene}: the checkpoint's scene is missing or cannot be read ({problem.strerror}); {anew}"
        ) from None
    if len(found) != told["size"]:
        raise error(
            f"{scene}: the checkpoint's scene is truncated or too long: {len(found)} bytes instead of {told['size']}; {anew}"
        )
    if hashlib.sha256(found).hexdigest() != told["sha256"]:
        raise error(f"{scene}: the checkpoint's scene is damaged: it does not match its checksum; {anew}")
    del found
    try:
        O.load(str(scene), quiet=True)
    except RuntimeError as problem:
        raise error(f"{scene}: the checkpoint's scene cannot be read ({problem}); {anew}") from None
    return {name: value for name, value in told.items() if name not in OWN}


def _told(path, again, anew, error):
    """The content of checkpoint.json once it matches its own checksum."""
    try:
        told = json.loads(path.read_text())
    except FileNotFoundError:
        raise error(f"{path}: there is no checkpoint to resume from; {again}, or give the right --out") from None
    except (OSError, ValueError, RecursionError) as problem:
        raise error(f"{path}: the checkpoint cannot be read ({problem}); {anew}") from None
    if not isinstance(told, dict) or not isinstance(told.get("format"), int):
        raise error(f"{path}: the checkpoint cannot be read (no format); {anew}")
    if told["format"] == FORMAT and told.pop("sum", None) != key_of(told):
        raise error(f"{path}: the checkpoint is damaged: it does not match its checksum; {anew}")
    return told


def _named(folder):
    return Path(folder) / "checkpoint" / "checkpoint.json"


@functools.cache
def _engines():
    """What must not change between saving and loading a scene: a class with another attribute would read the rest of
    the file as something else.
    """
    from yade import config

    return key_of([config.version, engines_key()])


@contextlib.contextmanager
def _saved(folder):
    """The scene as YADE saves it, a buffer. It goes to memory first, as YADE does not notice where a disk ends before
    the file does.
    """
    from yade import O

    with os.fdopen(os.memfd_create("scene"), "r+b", buffering=0) as file:
        try:
            O.save(f"/proc/self/fd/{file.fileno()}", quiet=True)
            size = os.fstat(file.fileno()).st_size
            os.pwrite(file.fileno(), b"\0", size)  # where a limit has cut the end off, this fails too
            os.ftruncate(file.fileno(), size)
            saved = mmap.mmap(file.fileno(), size, access=mmap.ACCESS_READ)
        except (OSError, RuntimeError, ValueError) as error:
            raise WriteError(
                f"{folder}: the checkpoint cannot be written ({getattr(error, 'strerror', None) or error}); give a folder that can be written and has "
                "room, and no limit on the size of files or on memory"
            ) from None
        with saved:
            yield saved
