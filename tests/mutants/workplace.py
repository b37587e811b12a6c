"""Where mutants live: copies of the checkout, the build of the one that holds those of the C++, and places to run tests
in.
"""
import contextlib
import json
import os
import shutil
import signal
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import Queue

from mutant import place, switch_all

ROOT = Path(__file__).resolve().parents[2]
TOOLS = {**os.environ, "PATH": "/usr/bin:/bin:/usr/sbin"}
PARTS = ("CMakeLists.txt", "cmake", "pkg", "py", "scripts", "tests", "doc")
UNWANTED = shutil.ignore_patterns("__pycache__", "*.png")
CLEAN = {k: v for k, v in os.environ.items() if k not in ("NONSMOOTH_MUTANT", "YADE_PREFIX", "PYTHONPATH")}


class BuildError(RuntimeError):
    """The copy could not be built; ``said``: all that the compiler said."""

    def __init__(self, message, said=""):
        super().__init__(message)
        self.said = said


def copy_sources(target):
    """The checkout without its pictures."""
    target.mkdir(parents=True)
    for name in PARTS:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, target / name, ignore=UNWANTED, symlinks=True)
        else:
            shutil.copy2(ROOT / name, target / name)


def mutated_sources(target, mutants):
    """The copy with all mutants of the C++; a file that did not change keeps its time, so that only what changed is
    built again, and one that did has a new one, also where it is the checkout's again."""
    fresh = target.with_name(target.name + ".new")
    shutil.rmtree(fresh, ignore_errors=True)
    copy_sources(fresh)
    switch_all(fresh, mutants)
    for path in fresh.rglob("*"):
        old = target / path.relative_to(fresh)
        if path.is_file() and old.is_file():
            if old.read_bytes() == path.read_bytes():
                os.utime(path, ns=(old.stat().st_atime_ns, old.stat().st_mtime_ns))
            else:
                os.utime(path)
    shutil.rmtree(target, ignore_errors=True)
    fresh.rename(target)


def build(source, folder, main_build, targets, *ninja):
    """Configures the copy as ``main_build`` is, and builds the targets; ``ninja``: its options. Raises BuildError."""
    known = dict(
        line.split("=", 1)
        for line in (main_build / "CMakeCache.txt").read_text().splitlines()
        if "=" in line and line[0] not in "#/"
    )
    options = [
        f"-D{key}={value}"
        for key, value in known.items()
        if key.partition(":")[0] in ("YADE_PREFIX", "YADE_HEADERS", "CMAKE_CXX_COMPILER_LAUNCHER")
    ]
    if not any("LAUNCHER" in o for o in options) and shutil.which("ccache"):
        options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    # -O1: fast enough for tests of seconds, and much of the time goes into YADE's headers
    options += [
        "-DCMAKE_BUILD_TYPE=Mutation",
        "-DCMAKE_CXX_FLAGS_MUTATION=-O1 -DNDEBUG",
        f"-DCMAKE_CXX_FLAGS=-w -include {source}/pkg/contact/mutant.hpp",
        "-DNONSMOOTH_BENCHMARKS=OFF",
        "-DNONSMOOTH_CHECKS=OFF",
    ]
    for command in (
        ["cmake", "-G", "Ninja", "-S", source, "-B", folder, *options],
        ["ninja", "-C", folder, *ninja, *targets],
    ):
        done = subprocess.run(
            [str(c) for c in command], env=TOOLS, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        if done.returncode:
            raise BuildError(f"the copy could not be built:\n{done.stdout[-6000:]}", done.stdout)


def share(places, items, work):
    """Calls ``work(place, item)`` for all items, as many at a time as there are places; yields (item, what it returned)
    in their order.
    """
    free = Queue()
    for one in places:
        free.put(one)

    def call(item):
        place = free.get()
        try:
            return work(place, item)
        finally:
            free.put(place)

    with ThreadPoolExecutor(len(places)) as pool:
        try:
            yield from zip(items, pool.map(call, items))
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


class Place:
    """A checkout of its own with a prefix of links to a build, for tests of one mutant after the other."""

    def __init__(self, folder, built, main_build):
        """``built``: the build whose libraries are used; ``main_build``: that of the checkout, for what only it has."""
        self.folder, self.source, self.build, self.main_build, self._changes, self._servers = (
            folder,
            folder / "checkout",
            folder / "build",
            main_build,
            0,
            {},
        )
        shutil.rmtree(folder, ignore_errors=True)
        copy_sources(self.source)
        self._link_prefix(built / "prefix")
        self.tests = built / "contact_tests"
        # what tests ask and nothing is mutated in: the oracles, a viewer's lock, a gate of another layout
        for name in ("oracle", "libnonsmooth_drawing_lock.so", "wrong_layout"):
            if (main_build / name).exists():
                (self.build / name).symlink_to(main_build / name)

    def _link_prefix(self, prefix):
        own = self.build / "prefix"
        for root, folders, files in os.walk(prefix):
            here = own / Path(root).relative_to(prefix)
            here.mkdir(parents=True, exist_ok=True)
            if "nonsmooth" in folders:
                (here / "nonsmooth").symlink_to(self.source / "py" / "nonsmooth")
                folders.remove("nonsmooth")
            for name in files:
                path = Path(root, name)
                if path.is_symlink():
                    (here / name).symlink_to(os.readlink(path))
                elif here.name == "bin":
                    (here / name).write_text(path.read_text().replace(str(prefix), str(own)))
                    (here / name).chmod(0o755)
                else:
                    (here / name).symlink_to(path)
        python = self.build / "python"
        python.mkdir()
        (python / "nonsmooth").symlink_to(self.source / "py" / "nonsmooth")
        for module in own.rglob("_nonsmooth_*.so"):
            (python / module.name).symlink_to(module)

    def change(self, mutated):
        """Puts a mutant that is not compiled into the checkout; returns a function that takes it out again."""
        kept = {}
        for file, old, new in mutated.edits:
            text, begin = place(self.source, mutated, file, old)
            kept.setdefault(file, text)
            self._write(file, text[:begin] + new + text[begin + len(old) :])
        return lambda: [self._write(file, text) for file, text in kept.items()]

    def _write(self, file, text):
        path = self.source / file
        path.write_text(text)
        self._changes += 1
        later = path.stat().st_mtime + 2 * self._changes  # or a cached module of the same second and size would do
        os.utime(path, (later, later))

    def run(self, command, number=0, limit=600.0, folder=None):
        """Runs a command with the mutant of a number, in the checkout or another ``folder``; returns (status, output),
        the status None where it was stopped after ``limit`` seconds."""
        with self._environment(number) as environment:
            process = subprocess.Popen(
                [str(c) for c in command],
                env={**CLEAN, **environment},
                cwd=folder or self.source,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                start_new_session=True,
            )
            try:
                said, status = process.communicate(timeout=limit)[0], process.returncode
            except subprocess.TimeoutExpired:
                status = None
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)  # and what it has started
            return status, process.communicate()[0] if status is None else said

    def pytest(self, arguments, yade, number=0, limit=600.0):
        """The same for pytest, in YADE or not; a negative status is that of a signal."""
        if yade not in self._servers:
            self._servers[yade] = Server(self, yade)
        with self._environment(number) as environment:
            output = Path(environment["TMPDIR"], "said")
            try:
                status = self._servers[yade].ask(
                    {
                        "arguments": ["-p", "no:cacheprovider", "-ra", "-q", *arguments],
                        "environment": environment,
                        "number": number,
                        "output": str(output),
                        "limit": limit,
                    }
                )
            except OSError as error:
                self._servers.pop(yade).close()
                return 3, f"the process that runs pytest has ended ({error})"
            return status, output.read_text(errors="replace") if output.exists() else ""

    @contextlib.contextmanager
    def _environment(self, number):
        """What a mutant's tests find: a cache and temporary files of their own, since nothing that one mutant has made
        may be taken for another's.
        """
        with tempfile.TemporaryDirectory(dir=self.folder) as work:
            yield {
                "NONSMOOTH_BUILD": str(self.build),
                "XDG_CACHE_HOME": f"{work}/cache",
                "TMPDIR": work,
                "NONSMOOTH_MUTANT": str(number),
            }

    def close(self):
        for server in self._servers.values():
            server.close()


class Server:
    """A server.py at a Place."""

    def __init__(self, place, yade):
        asks, answers = os.pipe(), os.pipe()
        program = (
            [place.source / "scripts" / "yade-nonsmooth", "tests/mutants/server.py"]
            if yade
            else ["/usr/bin/python3", "tests/mutants/server.py"]
        )
        threads = ["--threads", "1"] if yade else []  # several work side by side
        # what several files of tests use is found by the folder of conftest.py, which these do not read
        plain = {"PYTHONPATH": os.pathsep.join(map(str, (place.build / "python", place.source / "tests" / "yade")))}
        environment = {**CLEAN, "NONSMOOTH_BUILD": str(place.build)} | ({} if yade else plain)
        with open(place.folder / f"server-{'yade' if yade else 'plain'}.log", "w") as log:
            self._process = subprocess.Popen(
                [str(c) for c in (*program, asks[0], answers[1], *threads)],
                env=environment,
                cwd=place.source,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                pass_fds=(asks[0], answers[1]),
            )
        os.close(asks[0])
        os.close(answers[1])
        self._asks, self._answers = os.fdopen(asks[1], "w"), os.fdopen(answers[0])
        if self._answers.readline() != "ready\n":
            raise BuildError(f"{' '.join(map(str, program))} does not start, see {log.name}")

    def ask(self, job):
        print(json.dumps(job), file=self._asks, flush=True)
        answer = self._answers.readline()
        if not answer:
            raise OSError("no answer")
        return json.loads(answer)

    def close(self):
        with contextlib.suppress(OSError):
            self._asks.close()
        self._answers.close()
        self._process.wait()
