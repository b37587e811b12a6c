"""Measurements in processes, one after the other, with a note of how far they are."""

from __future__ import annotations

import threading
from pathlib import Path

from ...running import processes
from .states import BenchmarkError

__all__ = ["MeasuringCourse"]


class MeasuringCourse:
    """Calls functions in YADE processes of their own, each in a folder below ``out/runs`` that keeps its log.

    ``total``: seconds foreseen for all of them; ``progress``: called with the share done and the name of what is being
    done, every second.
    """

    def __init__(self, out, total, progress):
        self.home, self.total, self.progress, self.gone = (Path(out) / "runs").resolve(), total, progress, 0.0

    def call(self, name, seconds, function, arguments, threads=1):
        """What ``function(folder, **arguments)`` returns, see processes.call; ``seconds``: foreseen for it. Raises
        BenchmarkError where it fails.

        A function that takes long may write the share it has done to ``folder/progress``.
        """
        folder = self.home / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "progress").unlink(missing_ok=True)
        ended = threading.Event()
        watcher = threading.Thread(target=self._watch, args=(folder, seconds, ended), daemon=True)
        watcher.start()
        try:
            return processes.call(function, folder, arguments, threads)
        except processes.RunError as error:
            raise BenchmarkError(f"{name}: {error}") from None
        finally:
            ended.set()
            watcher.join()
            self.gone += seconds

    def _watch(self, folder, seconds, ended):
        while not ended.is_set():
            try:
                share = float((folder / "progress").read_text())
            except (OSError, ValueError):
                share = 0.0
            self.progress(min(1.0, (self.gone + share * seconds) / self.total), folder.name)
            ended.wait(1.0)
