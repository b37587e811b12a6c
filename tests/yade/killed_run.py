"""A slope with a checkpoint at every row, which kills itself: scripts/yade-nonsmooth tests/yade/killed_run.py SECTION
DISKS OUT END LOOK [--resume].

LOOK: number of the access to a file below OUT (opening, renaming, removing, …) before which the process is killed; 0:
never, and the file OUT.looks then tells how many there were.
"""
import os
import signal
import sys
from pathlib import Path

from yade.nonsmooth import commands, experiment, section
from yade.nonsmooth.course import driver

source, disks, out, end, look = (
    sys.argv[1],
    int(sys.argv[2]),
    Path(sys.argv[3]).resolve(),
    float(sys.argv[4]),
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
    chosen = section.load(source).with_disks(disks)
    out.mkdir(exist_ok=True)
    sys.addaudithook(watch)
    if "--resume" in sys.argv:
        run = experiment.resume(chosen, out)
    else:
        run = experiment.begin(chosen, out)
    run.run(end)
    if not look:
        out.with_suffix(".looks").write_text(str(seen))


driver.CHECKPOINT_SECONDS, driver.CHECKPOINT_SHARE = 0, 1e9
commands.run(main)
