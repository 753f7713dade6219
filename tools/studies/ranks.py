"""Runs of the program over ranks and threads, for the studies beside this file."""

import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PUNCH = ROOT / "inputs" / "punch"

# Open MPI takes more ranks than cores, leaves them unbound, and runs for root, as in a container.
ENVIRONMENT = dict(os.environ, OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none",
                   OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def command(tamp, ranks, arguments):
    """The words of a command line; one rank needs no launcher."""
    launcher = [] if ranks == 1 else ["mpiexec", "-n", str(ranks)]
    return launcher + [str(tamp), "run", *map(str, arguments), "--quiet"]


def run(tamp, ranks, arguments):
    """Runs to the end; stops the study with what the program said if it fails."""
    done = subprocess.run(command(tamp, ranks, arguments), env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"exit code {done.returncode}: {done.stderr}")


def summary(folder):
    return json.loads((pathlib.Path(folder) / "summary.json").read_text())


def digest(folder):
    return summary(folder)["state_digest"]
