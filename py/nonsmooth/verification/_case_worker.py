"""One case of a check, see cases.py: a script for YADE with the arguments REQUEST (JSON) and FOLDER."""
import importlib
import json
import sys
from pathlib import Path

from yade.nonsmooth.packing_files import write_atomically

request, folder = json.loads(sys.argv[-2]), Path(sys.argv[-1])
found = getattr(importlib.import_module(request["module"]), request["function"])(folder, **request["case"])
write_atomically(folder / "found.json", json.dumps(found, indent=1).encode())
