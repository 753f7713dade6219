#!/usr/bin/env python3
"""The state digest of every scene of the punch over ranks and threads, and of runs that go on with other ranks.

    tools/studies/same_bits.py [--tamp build/release/tamp] [--steps 100] [--methods]

With --methods of the quick punch by every interpolator and transfer. Prints a table; the exit code is 1 if any digest differs from that of one rank and one thread."""

import argparse
import pathlib
import sys
import tempfile

import ranks

SCENES = ["quick", "table", "svr", "mlp"]
INTERPOLATORS = ["linear", "gimp", "cpgimp", "cpdi", "quadratic_spline", "cubic_spline"]
TRANSFERS = ["flip", "pic", "blend", "affine", "apic", "tpic", "xpic", "fmpm"]
CREWS = [(r, t) for r in (1, 2, 3, 4) for t in (1, 2, 3)]
RESTARTS = [((1, 1), (3, 1)), ((2, 2), (1, 3)), ((4, 1), (2, 2)), ((3, 2), (4, 1))]


def scenes():
    """Names, and what comes behind `tamp run`."""
    return {name: [ranks.PUNCH / f"{name}.json"] for name in SCENES}


def methods():
    """The quick punch by every interpolator and transfer that go together. Linear weights have no spread on a node, which
    "apic" needs, and no step rule of their own: by the published one, and only in short steps, they endure the impact."""
    quick = ranks.PUNCH / "quick.json"
    short_steps = ["--set", "/time/rule=published", "--set", "/time/multiplier=0.2"]
    return {f"{interpolator}, {transfer}":
            [quick, "--set", f"/interpolator={interpolator}", "--set", f"/transfer={transfer}"]
            + (short_steps if interpolator == "linear" else [])
            for interpolator in INTERPOLATORS for transfer in TRANSFERS
            if (interpolator, transfer) != ("linear", "apic")}


def straight(tamp, scene, crew, n_steps, folder):
    n_ranks, n_threads = crew
    ranks.run(tamp, n_ranks, [*scene, "--steps", n_steps, "--threads", n_threads, "--out", folder])
    return ranks.digest(folder)


def restarted(tamp, scene, crews, n_steps, folder):
    (ranks_before, threads_before), (ranks_after, threads_after) = crews
    half = n_steps // 2
    ranks.run(tamp, ranks_before, [*scene, "--steps", half + 5, "--checkpoint-steps", half, "--threads", threads_before,
                                   "--out", folder])
    ranks.run(tamp, ranks_after, [*scene, "--steps", n_steps, "--threads", threads_after, "--restart", folder])
    assert ranks.summary(folder)["restarted_at_step"] == half
    return ranks.digest(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tamp", type=pathlib.Path, default=ranks.ROOT / "build/release/tamp")
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--methods", action="store_true", help="every interpolator and transfer")
    options = parser.parse_args()
    n_different = 0
    print("| scene | digest of one rank, one thread | ranks x threads with the same | restarts with the same |")
    print("| --- | --- | --- | --- |")
    for name, scene in (methods() if options.methods else scenes()).items():
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            found = {crew: straight(options.tamp, scene, crew, options.steps, place / f"{crew[0]}x{crew[1]}")
                     for crew in CREWS}
            again = {crews: restarted(options.tamp, scene, crews, options.steps, place / f"restart{k}")
                     for k, crews in enumerate(RESTARTS)}
        expected = found[1, 1]
        same = [f"{r}x{t}" for (r, t), digest in found.items() if digest == expected]
        same_again = [f"{a[0]}x{a[1]} to {b[0]}x{b[1]}" for (a, b), digest in again.items() if digest == expected]
        n_different += len(found) - len(same) + len(again) - len(same_again)
        print(f"| {name} | {expected} | {', '.join(same)} | {', '.join(same_again)} |", flush=True)
    print(f"{n_different} digests differ")
    return 1 if n_different else 0


if __name__ == "__main__":
    sys.exit(main())
