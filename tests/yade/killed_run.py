"""A slope with a checkpoint at every row, which kills itself: scripts/yade-nonsmooth tests/yade/killed_run.py SECTION
DISKS OUT END LOOK [--resume].

DISKS: 0 for the section's own. END [s], or "factor" for a search for the factor of safety instead of a run, which goes
on from a checkpoint by itself. LOOK: number of the access to a file below OUT (opening, renaming, removing, …) before
which the process is killed; 0: never, and the file OUT.looks then tells how many there were.
"""
import os
import signal
import sys
from pathlib import Path

from yade.nonsmooth import commands, experiment, section
from yade.nonsmooth.course import driver
from yade.nonsmooth.studies.safety import asked, search

source, disks, out, end, look = (
    sys.argv[1],
    int(sys.argv[2]),
    Path(sys.argv[3]).resolve(),
    sys.argv[4],
    int(sys.argv[5]),
)
LOOKS = ("open", "os.rename", "os.remove", "os.truncate", "os.mkdir", "os.listdir", "os.scandir")
seen = 0


def watch(event, arguments):
    global seen
    if event in LOOKS and str(arguments[0]).startswith(str(out)):
        seen += 1
        if seen == look:
            os.kill(os.getpid(), signal.SIGKILL)


def main():
    chosen = section.load(source)
    chosen = chosen.with_disks(disks) if disks else chosen
    out.mkdir(exist_ok=True)
    sys.addaudithook(watch)
    if end == "factor":
        search.run(asked.Asked(chosen, numbers={"step": 0.2, "within": 0.2}), out)
    elif "--resume" in sys.argv:
        course = experiment.resume(chosen, out)
        if not course.reached(float(end)):  # else it was killed after its last checkpoint
            course.run(float(end))
    else:
        experiment.begin(chosen, out).run(float(end))
    if not look:
        out.with_suffix(".looks").write_text(str(seen))


driver.CHECKPOINT_SECONDS, driver.CHECKPOINT_SHARE = 0, 1e9
commands.run(main)
