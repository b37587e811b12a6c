"""One call in a process of its own, see processes.py: a script for YADE with the argument FOLDER."""
import ctypes
import importlib
import json
import os
import signal
import sys
import traceback
from pathlib import Path

from yade.nonsmooth import servers
from yade.nonsmooth.errors import UserError
from yade.nonsmooth.running import interrupts
from yade.nonsmooth.system.whole_files import write_atomically, write_json

PR_SET_PDEATHSIG = 1  # <sys/prctl.h>

servers.close()  # where the plugin is installed into a YADE, whose own program opens them
folder = Path(sys.argv[-1])
request = json.loads((folder / "request.json").read_text())
# a command that is killed must not leave runs behind that write on into its folder
ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
if os.getppid() != request["parent"]:
    sys.exit(1)
interrupts.be_patient()
try:
    with interrupts.never_lost():
        module, name = request["function"].split(":")
        function = getattr(importlib.import_module(f"yade.nonsmooth.{module}"), name)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})  # one that came while this process began waits
        found = function(folder, **request["arguments"])
except UserError as error:
    traceback.print_exc()
    write_atomically(folder / "refused.txt", str(error).encode())
    sys.exit(1)
except KeyboardInterrupt as stop:
    print(f"stopped: {stop}")
    sys.exit(130)
write_json(folder / "found.json", found)
