"""A plan's files for a cluster: a Snakefile for Snakemake, and an array job for Slurm. Both call scripts/sweep.py for
each run.
"""

from __future__ import annotations

import json
import shlex
import sys
from pathlib import Path

from ..system.whole_files import write_atomically

__all__ = ["write"]

SCRIPT = Path(__file__).resolve().parents[3] / "scripts" / "sweep.py"

SNAKEFILE = """\
# The runs of plan.json: `snakemake --cores 4` in this folder. Runs of other input, engines or code have other keys, and Snakemake does them again.
KEYS = {keys}

rule all:
    input: "table.csv"

rule table:
    input: expand("runs/{{run}}/result.json", run=KEYS)
    output: "table.csv"
    shell: {command:r} " --collect"

rule run:
    output: "runs/{{run}}/result.json"
    params: key=lambda wildcards: KEYS[wildcards.run]
    threads: 1
    shell: {command:r} " --run {{wildcards.run:q}}"
"""

ARRAY = """\
#!/bin/sh
# The runs of plan.json: `sbatch array.sh` in this folder; then `{command} --collect` for the table.
#SBATCH --job-name={name}
#SBATCH --array=0-{last}
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm-%A_%a.out
cd "${{SLURM_SUBMIT_DIR:-.}}" || exit 1
exec {command} --number "$SLURM_ARRAY_TASK_ID"
"""


class _Quoted(str):
    """Text that a Snakefile holds as a string, where braces are wildcards."""

    def __format__(self, spec):
        return repr(self.replace("{", "{{").replace("}", "}}")) if spec == "r" else str(self)


def write(out, title, keys):
    """Writes both into the folder ``out``; ``keys``: of the runs, by their names, in the order of the plan."""
    command = _Quoted(shlex.join([sys.executable, str(SCRIPT), "--out", "."]))
    name = "".join(c if c.isalnum() or c in "-_." else "-" for c in title) or "campaign"
    write_atomically(
        Path(out) / "Snakefile", SNAKEFILE.format(keys=json.dumps(keys, indent=4), command=command).encode()
    )
    write_atomically(Path(out) / "array.sh", ARRAY.format(command=command, name=name, last=len(keys) - 1).encode())
