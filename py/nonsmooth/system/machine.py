"""What the numbers were measured on."""

from __future__ import annotations

import datetime
import os
import platform
from pathlib import Path

__all__ = ["describe", "resident_bytes"]


def describe() -> dict:
    """Processor, its cores and caches, compiler, versions, load average and date, as far as the system tells."""
    import _nonsmooth_contact
    from yade import config

    return {
        "cpu": _cpu_model(),
        "cores": os.cpu_count(),
        "caches": _caches(),
        "memory_GB": _memory(),
        "compiler": _nonsmooth_contact.compiler,
        "best_path": _nonsmooth_contact.kernels[0],
        "system": platform.platform(),
        "python": platform.python_version(),
        "yade": config.version,
        "load_average": list(os.getloadavg()),
        "date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
    }


def resident_bytes() -> int:
    """Memory of this process that is in use [byte]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def _cpu_model():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    return next(
        (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")),
        platform.processor() or platform.machine(),
    )


def _caches():
    """Sizes of the first core's caches, as {"L1 Data": "32K", …}."""
    found = {}
    for cache in sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        try:
            level, kind, size = ((cache / name).read_text().strip() for name in ("level", "type", "size"))
        except OSError:
            continue
        found[f"L{level}" + ("" if kind == "Unified" else f" {kind}")] = size
    return found


def _memory():
    return round(1e-9 * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"), 1)
