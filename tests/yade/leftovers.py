"""What killed processes leave behind: files that were being written beside those that they were to be."""

from pathlib import Path


def plant(folder, *names):
    """Leaves, for each file, one that was cut off in the middle of the writing, and one that was whole but not yet
    renamed.
    """
    for name in names:
        path = Path(folder, name)
        content = path.read_bytes() if path.is_file() else b"PK\x03\x04 what a file begins with, and goes on with"
        path.parent.mkdir(parents=True, exist_ok=True)
        for token, part in (("0123abcd", content[: len(content) // 2]), ("89abcdef01234567", content)):
            path.with_name(f".part-{token}-{path.name}").write_bytes(part)


def found(folder):
    """Names of such files in a folder and below it."""
    return sorted(path.relative_to(folder).as_posix() for path in Path(folder).rglob(".part-*"))
