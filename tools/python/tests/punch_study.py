"""A study as `tamp study` writes it, with everything that one may have: made up, but like the punch."""

import copy

SIZES = [0.04, 0.02, 0.01, 0.005]
# Greatest depth [m] and user time [s] by method and cell size.
DEPTHS = {
    "flatter": [0.1837, 0.1899, 0.2025, 0.2085], "steel": [0.1971, 0.2019, 0.2069, 0.2106],
    "regression": [0.1905, 0.1982, 0.2038], "flatter, rigid": [0.1753, 0.1851, 0.2009, None]}
TIMES = {
    "flatter": [0.6, 4.5, 36, 290], "steel": [0.7, 4.8, 38, 310], "regression": [0.9, 6.5, 52],
    "flatter, rigid": [0.3, 2.1, 17, 140]}
REFERENCE = 0.2141
FAMILIES = {"flatter": "deformable", "steel": "deformable", "regression": "fitted", "flatter, rigid": "rigid"}


def point(number, method, size, depth, time):
    """Errors of depth are of the reference; those of time over the curve are made up."""
    steps = round(2279 * 0.02 / size)
    error = abs(depth / REFERENCE - 1) if depth else None
    command = f"tamp run inputs/punch/quick.json --set /grid/cell_size={size} --set '/contact/0/normal=\"{method}\"'"
    made = {
        "id": number, "method": method, "label": f"cell size {size}",
        "settings": {"/grid/cell_size": size, "/contact/0/normal": method}, "refine": size, "ended": "done",
        "reason": "",
        "cost": {"core_s": time, "core_s_low": 0.98 * time, "core_s_high": 1.07 * time, "particle_steps": 2e6 * time,
                 "steps": steps},
        "values": {"greatest depth": depth},
        "errors": {"greatest depth": error, "depth over time": error and error / 2 + 0.002},
        "front": [], "command": command}
    return made if depth else failed(made, "limit", "600 s, 100 times as long as the fastest run")


def failed(made, ended, reason):
    return {**made, "ended": ended, "reason": reason, "values": {}, "errors": {}}


def points():
    made = []
    for method, depths in DEPTHS.items():
        for size, depth, time in zip(SIZES, depths, TIMES[method]):
            made.append(point(len(made) + 1, method, size, depth, time))
    unstable = point(len(made) + 1, "regression", 0.005, 0.2, 96)
    made.append(failed(unstable, "unstable", "step 1822: the energy error of 14 % is beyond the limit of 5 %"))
    refused = point(len(made) + 1, "regression", 0.0025, 0.2, 0)
    made.append({**failed(refused, "refused", "a forecast of 9.1 GB of memory, where 4 GB are free"), "cost": {}})
    mark_front(made, "greatest depth")  # the other quantity has no bound
    return made


def mark_front(made, quantity):
    """By brute force: no other run is at least as cheap and as good."""
    known = [(p["cost"]["core_s"], p["errors"][quantity], p) for p in made if p["ended"] == "done"]
    for cost, error, p in known:
        if not any((c <= cost and e <= error and (c, e) != (cost, error)) for c, e, _ in known):
            p["front"].append(quantity)


def orders():
    fits = {"flatter": (1, 1.02), "steel": (5, 0.74), "regression": (9, 0.65), "flatter, rigid": (12, 1.1)}
    counts = {"flatter": 4, "steel": 4, "regression": 3, "flatter, rigid": 3}
    return [{"method": m, "label": m, "points": list(range(first, first + counts[m])), "order": order, "note": ""}
            for m, (first, order) in fits.items()]


STUDY = {
    "name": "punch", "title": "How deep the punch goes, and what a percent costs",
    "about": "A steel punch is driven into sand. Which normal of contact gives its greatest depth for the least work?",
    "takes": "40 minutes on one core; --short 2 minutes", "command": "tamp study inputs/studies/punch.json",
    "program": "tamp 0.1.0, release, x86-64-v2\nEigen 3.4.0, oneTBB 2021.8",
    "machine": {"processor": "Example processor at 3 GHz", "instruction_set": "AVX2", "cores": 2},
    "threads": 1, "repeat": 3,
    "costs": [{"key": "core_s", "name": "user time", "unit": "s"},
              {"key": "particle_steps", "name": "particle-steps", "unit": ""}],
    "refine": {"pointer": "/grid/cell_size", "name": "cell size", "unit": "m"},
    "methods": [{"name": name, "family": family, "dashed": name == "regression"} for name, family in FAMILIES.items()],
    "quantities": [
        {"name": "greatest depth", "unit": "m", "relative": True,
         "reference": {"kind": "extrapolated", "value": REFERENCE, "uncertainty": 0.012, "order": 0.9, "bound": True,
                       "note": "differences fall by 1.9 from grid to grid"},
         "orders": orders()},
        {"name": "depth over time", "unit": "m", "relative": True,
         "reference": {"kind": "finest", "value": None, "uncertainty": None, "order": None, "bound": False,
                       "note": "no bound: differences do not fall from grid to grid"},
         "orders": [{**fit, "order": None, "note": "fewer than three grids on which errors fall"}
                    for fit in orders()[:1]]}],
    "points": points(),
    "budgets": [
        {"quantity": "greatest depth", "unit": "m", "of": of, "value": value, "parts": [
            {"name": "grid", "amount": 0.034, "note": "to the reference"},
            {"name": "time step", "amount": 0.0021, "note": "half the multiplier"},
            {"name": "particles", "amount": 0.0124, "note": "16 a cell"},
            {"name": "contact", "amount": 0.019, "note": "steel's normal"},
            {"name": "modulus model", "amount": 0.003 * k, "note": "against the measured curves"},
            {"name": "measured scatter", "amount": None, "note": "no bound: one test of each kind"}]}
        for k, (of, value) in enumerate([("Table", 0.2025), ("SVR", 0.2031), ("MLP", 0.2002)])]}


def study(**changes):
    return {**copy.deepcopy(STUDY), **changes}
