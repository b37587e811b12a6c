"""Checkpoints: the scene beside a small JSON file that names it; the earlier one stays until the new one is whole."""

from __future__ import annotations

import functools
import hashlib
import json
from pathlib import Path

from yade import O, config

from .whole_files import beside, write_atomically

__all__ = ["digest", "engines_key", "exists", "key_of", "read", "write"]


def key_of(plain):
    """Key of plain data (what JSON can hold), to tell whether a checkpoint belongs to a run."""
    return hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()


def engines_key():
    """Key of the engines as they were built: what they have computed and a cache keeps is another build's, perhaps by its last bits, once they change."""
    return digest(Path(config.libDir, "nonsmooth_engines.so"))


@functools.cache
def digest(path):
    """SHA-256 of a file's bytes; a Path is read once in a process."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def exists(folder):
    """Whether there is a checkpoint in ``folder``."""
    return (Path(folder) / "checkpoint" / "checkpoint.json").exists()


def write(folder, key, content):
    """Saves the scene and ``content`` (what JSON can hold) below ``folder``."""
    folder = Path(folder) / "checkpoint"
    name = f"scene-{O.iter:08d}.yade"  # as gzip it would take half the room and three times as long
    with beside(folder / name) as part:
        O.save(str(part), quiet=True)
    head = {"format": 1, "scene": name, "size": (folder / name).stat().st_size, "step": O.iter, "key": key}
    write_atomically(folder / "checkpoint.json", json.dumps({**head, **content}, indent=1).encode())
    for old in folder.glob("scene-*.yade*"):
        if old.name != name:
            old.unlink()


def read(folder, key, error):
    """Loads the scene of the checkpoint below ``folder`` and returns its content.

    Raises ``error`` (an exception class) where there is none, where it is damaged, or where its key is another than ``key``.
    """
    path = Path(folder) / "checkpoint" / "checkpoint.json"
    try:
        content = json.loads(path.read_text())
        scene, size = path.parent / content["scene"], content["size"]
    except FileNotFoundError:
        raise error(f"{path}: there is no checkpoint to resume from; run without --resume, or give the right --out") from None
    except (OSError, ValueError, KeyError, TypeError) as problem:
        raise error(f"{path}: the checkpoint cannot be read ({problem}); remove {path.parent} and run without --resume") from None
    if not scene.exists() or scene.stat().st_size != size:
        raise error(f"{scene}: the checkpoint is missing or truncated; remove {path.parent} and run without --resume")
    if content.get("key") != key:
        raise error(f"{path}: this checkpoint belongs to other settings (input, number of disks or seed); give the same ones, or another --out")
    try:
        O.load(str(scene), quiet=True)
    except RuntimeError as problem:
        raise error(f"{scene}: the checkpoint cannot be read ({problem}): it is damaged, or another version of the plugin wrote it; "
                    f"remove {path.parent} and run without --resume") from None
    return content
