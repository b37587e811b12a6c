#!/usr/bin/env python3
"""Does anything in the suite pass by chance? Runs the tests that start a process, or send one a signal, many times on a
busy machine.

  tests/rounds/run.py [BUILD] [--rounds N] [--workers N] [--only TEST …] [--forget]

The first command runs all tests once and writes down which of them start a process or send a signal
(BUILD/rounds/tests.csv: see tests/yade/started.py). Each round runs all of those; --workers rounds go side by side, one
more than the machine has cores, so that each waits for others at moments of nobody's choice. What came of each round
stands in BUILD/rounds/rounds.csv, what a round that failed has said in its log beside it. The rounds of a commit are
counted together: the command can be stopped, and given again. The status is 1 where a round has failed.
"""
import argparse
import contextlib
import csv
import io
import os
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event, Lock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "py"))
from nonsmooth.system.whole_files import write_atomically

RUNNING, STOPPED = set(), Event()  # leaders of groups of processes; whether no more may begin
COLUMNS = ("commit", "round", "tests", "seconds", "status", "failed")


def read_arguments():
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "build",
        nargs="?",
        default=ROOT / "build",
        type=Path,
        metavar="BUILD",
        help="build folder of the checkout (default: build)",
    )
    parser.add_argument(
        "--rounds", type=int, default=50, metavar="N", help="rounds that the commit has in the end (default: 50)"
    )
    parser.add_argument(
        "--workers",
        type=int,
        default=os.cpu_count() + 1,
        metavar="N",
        help="rounds side by side (default: one more than cores)",
    )
    parser.add_argument("--only", nargs="+", metavar="TEST", help="tests whose id holds one of these words")
    parser.add_argument("--forget", action="store_true", help="begins anew: the list of tests and the rounds")
    args = parser.parse_args()
    if not (args.build / "CMakeCache.txt").is_file():
        parser.error(f"{args.build}: is no build folder; run scripts/setup.sh --tests first, or give one")
    for name in ("rounds", "workers"):
        if getattr(args, name) < 1:
            parser.error(f"--{name} {getattr(args, name)}: give 1 or more")
    return args


def commit():
    """The commit of the checkout, and whether files differ from it."""

    def git(*words):
        return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=True).stdout

    return git("rev-parse", "--short=12", "HEAD").strip() + ("+" if git("status", "--porcelain").strip() else "")


def pytest(build, log, *arguments):
    """Runs pytest in YADE, all it says into a file; its status."""
    command = [ROOT / "scripts" / "yade-nonsmooth", ROOT / "tests" / "yade" / "run_pytest.py", "--threads", "1"]
    with open(log, "w") as out:
        process = subprocess.Popen(
            [*map(str, command), *map(str, arguments)],
            env={**os.environ, "NONSMOOTH_BUILD": str(build), "PATH": "/usr/bin:/bin:/usr/sbin"},
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            start_new_session=True,  # so that all that it starts can be ended with it
        )
    RUNNING.add(process.pid)
    try:
        return process.wait()
    finally:
        RUNNING.discard(process.pid)


@contextlib.contextmanager
def pool(workers):
    """A ThreadPoolExecutor; what its calls of pytest have started is killed where this command is ended before them."""
    with ThreadPoolExecutor(workers) as made:
        try:
            yield made
        except BaseException:
            STOPPED.set()
            for leader in list(RUNNING):
                os.killpg(leader, signal.SIGKILL)
            raise


def tests_of(folder, build, workers):
    """Ids of the tests that start a process or send a signal, file by file; found by a run of all tests where that has
    not been done.
    """
    file = folder / "tests.csv"
    if not file.exists():
        print("which tests start a process: all run once …", flush=True)
        taken = folder / "taken"
        shutil.rmtree(taken, ignore_errors=True)

        def part(k):
            return pytest(build, folder / f"all{k}.log", "-q", "--share", taken, "--started", folder / f"part{k}.csv")

        with pool(workers) as parts:
            if any(parts.map(part, range(workers))):
                sys.exit(f"a test fails at once: see {folder}/all*.log")
        rows = [row for k in range(workers) for row in read(folder / f"part{k}.csv")]
        write(file, ("test", "seconds", "events"), sorted(rows, key=lambda row: row["test"].split("::")[0]))
    return [row["test"] for row in read(file)]


def read(file):
    if not file.exists():
        return []
    with open(file, newline="") as source:
        return list(csv.DictReader(source))


def write(file, columns, rows):
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, columns)
    writer.writeheader()
    writer.writerows(rows)
    write_atomically(file, text.getvalue().encode())


class Rounds:
    """The rounds of one commit."""

    def __init__(self, folder, build, tests, at):
        self._folder, self._build, self._tests, self._at = folder, build, tests, at
        self._file, self._lock = folder / "rounds.csv", Lock()

    def done(self):
        return [row for row in read(self._file) if row["commit"] == self._at and int(row["tests"]) == len(self._tests)]

    def run(self, number):
        if STOPPED.is_set():
            return
        log, scratch = self._folder / f"round{number}.log", self._folder / f"scratch{number}"
        begun = time.monotonic()
        status = pytest(self._build, log, "-q", "--basetemp", scratch, *self._tests)
        if STOPPED.is_set():
            return
        lines = log.read_text(errors="replace").splitlines()
        failed = [line.split(" ")[1] for line in lines if line.startswith(("FAILED ", "ERROR "))]
        row = dict(
            commit=self._at,
            round=number,
            tests=len(self._tests),
            seconds=f"{time.monotonic() - begun:.0f}",
            status=status,
            failed=" ".join(failed),
        )
        with self._lock:
            write(self._file, COLUMNS, [*read(self._file), row])
            print(
                f"round {number}: {row['seconds']} s, {'passed' if not status else f'status {status} {failed}'}",
                flush=True,
            )
        shutil.rmtree(scratch, ignore_errors=True)
        if not status:
            log.unlink()


def main():
    args = read_arguments()
    build = args.build.resolve()
    folder = build / "rounds"
    if args.forget:
        shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(exist_ok=True)
    tests = [f"{ROOT}/tests/yade/{test}" for test in tests_of(folder, build, args.workers)]
    if args.only:
        tests = [test for test in tests if any(word in test for word in args.only)]
    rounds = Rounds(folder, build, tests, commit())
    begun = len(rounds.done())
    print(f"{len(tests)} tests, {begun} of {args.rounds} rounds done", flush=True)
    with pool(args.workers) as side_by_side:
        list(side_by_side.map(rounds.run, range(begun + 1, args.rounds + 1)))
    done = rounds.done()
    failed = [row for row in done if row["status"] != "0"]
    print(f"{len(done)} rounds of {len(tests)} tests: {len(failed)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("stopped: what has ended is kept, give the command again to go on")
