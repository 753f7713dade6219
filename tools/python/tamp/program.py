"""TAMP's program: which one is meant, and how it is called."""

import json
import os
import pathlib
import resource
import subprocess

from tamp.failure import Failure, Refusal

ROOT = pathlib.Path(__file__).resolve().parents[3]
INPUTS = ROOT / "inputs"
SAND = INPUTS / "materials/concrete-sand"
USUAL = ROOT / "build/release/tamp"
MODELS = {"table": "Table", "svr": "SVR", "mlp": "MLP"}  # of the sand's stiffness

# Open MPI takes more ranks than cores, leaves them unbound, and runs for root, as in a container.
ENVIRONMENT = {**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
               "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def add_option(parser, **how):
    how = {"default": USUAL, "metavar": "PROGRAM", "help": "the program that is called (build/release/tamp)", **how}
    parser.add_argument("--tamp", type=pathlib.Path, **how)


def changes(settings):
    """The words --set of pointers and values, a dictionary or pairs. Texts stay as they are."""
    pairs = settings.items() if isinstance(settings, dict) else settings
    texts = [(pointer, value if isinstance(value, str) else json.dumps(value, default=str)) for pointer, value in pairs]
    return [word for pointer, value in texts for word in ("--set", f"{pointer}={value}")]


def command(tamp, *words, ranks=1):
    """The words of a call; a single rank needs no launcher."""
    launcher = [] if ranks == 1 else ["mpiexec", "-n", str(ranks)]
    return [*launcher, str(tamp), *map(str, words)]


def answer(tamp, *words, ranks=1, environment=ENVIRONMENT, folder=None):
    """How a call ended: exit code and texts. It is called in a folder, by default where Python is."""
    try:
        return subprocess.run(command(tamp, *words, ranks=ranks), env=environment, capture_output=True, text=True,
                              errors="replace", cwd=folder)
    except OSError as error:
        raise Refusal(tamp, error.strerror, "TAMP") from None


def call(tamp, *words, allowed=(0,), **how):
    """Refuses to go on where the program fails, or refuses what it was given. Gives its answer."""
    done = answer(tamp, *words, **how)
    if done.returncode not in allowed:
        kind = Refusal if done.returncode == Refusal.code else Failure
        raise kind(tamp, f"exit code {done.returncode}: {done.stderr.strip()}")
    return done


def run(tamp, scene, folder, *words, settings=(), **how):
    """Runs a scene into a folder, in place of what is there."""
    where = ["--out", folder, "--force", "--quiet"]
    return call(tamp, "run", scene, *where, *changes(settings), *words, **how)


def restart(tamp, scene, folder, *words, settings=(), **how):
    """Goes on with the run in a folder."""
    return call(tamp, "run", scene, "--restart", folder, "--quiet", *changes(settings), *words, **how)


def timed_run(*words, **how):
    """(user seconds, answer) of a run on one thread."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = run(*words, "--threads", 1, **how)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, done
