"""One call in a process of its own, see processes.py: a script for YADE with the argument FOLDER."""
import importlib
import json
import sys
import traceback
from pathlib import Path

from yade.nonsmooth import servers
from yade.nonsmooth.errors import UserError
from yade.nonsmooth.whole_files import write_atomically

servers.close()  # where the plugin is installed into a YADE, whose own program opens them
folder = Path(sys.argv[-1])
request = json.loads((folder / "request.json").read_text())
try:
    found = getattr(importlib.import_module(request["module"]), request["function"])(folder, **request["arguments"])
except UserError as error:
    traceback.print_exc()
    write_atomically(folder / "refused.txt", str(error).encode())
    sys.exit(1)
write_atomically(folder / "found.json", json.dumps(found, indent=1).encode())
