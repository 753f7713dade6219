"""Checks for data that no hydrostatic test of sand gives: then the file is not what it is taken for."""

from tamp.failure import Refusal
from tamp.laboratory.curves import (
    crossing, loading_branch, pressure_at, turning_point, unloading_branch, unloading_curve,
)

# How far a measured column may run back: noise, of the value and of the largest.
NOISE, LEAST_NOISE = 0.02, 0.002
NOISE_OF_STRAIN = 0.01  # of the largest
NEARLY_ZERO = 0.05  # of the largest
LEAST_ROWS = 3  # of a branch
# The widest step from row to row, of the largest; a test of few rows may have wider ones, by their number.
WIDEST_OF_STRAIN, WIDEST_OF_PRESSURE = (0.1, 4), (0.25, 6)
COLUMNS_HINT = "strain is column 1, pressure column 2"

# The mean bulk modulus of unloading grows about with the root of the pressure unloaded from. At 0.1 MPa that of sands
# is 50 to 200 MPa; a unit that is misread is off by a hundred or a thousand. Beyond the last, no sand's grains are.
SOFTEST, STIFFEST, AT_PRESSURE = 5e6, 1e9, 1e5
STIFFEST_GRAINS = 150e9


def check_test(test):
    """Check a test by itself."""
    turn = turning_point(test.rows)
    strain, pressure = test.rows[turn]
    if pressure <= 0 or strain <= 0:
        raise Refusal(test.path, f"a strain of {strain:g} at the largest pressure, {pressure:g} Pa",
                      "compression to be positive")
    largest = max(range(len(test.rows)), key=lambda i: test.rows[i][0])
    if test.rows[largest][0] >= 1:
        raise Refusal(f"{test.path}:{test.lines[largest]}", f"a strain of {test.rows[largest][0]:g}",
                      "less than 1 (is --strain right?)")
    check_one_cycle(test, turn)
    check_strains(test, turn)
    check_no_gap(test, turn)
    check_branches(test, turn)
    plastic, points = unloading_curve(test.rows)
    if plastic < 0:
        raise Refusal(test.path, f"a strain of {plastic:g} after unloading", "none that is negative")
    check_stiffness(test.path, *points[-1])


def check_one_cycle(test, turn):
    """Pressure up to the largest one, then down."""
    peak = test.rows[turn][1]
    high = low = 0  # rows of the largest pressure so far, and of the least one after it
    for i, (_, pressure) in enumerate(test.rows):
        if pressure > test.rows[high][1]:
            high = low = i
        if pressure < test.rows[low][1]:
            low = i
        fallen = not within_noise(test.rows[high][1], test.rows[low][1], peak)
        if fallen and not within_noise(pressure, test.rows[low][1], peak):
            raise Refusal(f"{test.path}:{test.lines[low]}", "a second cycle, or a wrong row: from here the pressure "
                          f"rises again, from {test.rows[low][1]:g} to {pressure:g} Pa in line {test.lines[i]}",
                          "one loading and one unloading in a file")


def within_noise(high, low, largest):
    return high - low <= NOISE * abs(high) + LEAST_NOISE * largest


def check_strains(test, turn):
    """Strain grows with the pressure, and shrinks with it."""
    bound = NOISE_OF_STRAIN * test.rows[turn][0]
    largest, least = test.rows[0][0], test.rows[turn][0]
    for i, (strain, _) in enumerate(test.rows):
        largest, least = max(largest, strain), min(least, strain) if i > turn else least
        if i <= turn and strain < largest - bound:
            raise Refusal(f"{test.path}:{test.lines[i]}", f"a strain of {strain:g} after {largest:g} in loading",
                          f"strain to grow ({COLUMNS_HINT})")
        if i > turn and strain > least + bound:
            raise Refusal(f"{test.path}:{test.lines[i]}", f"a strain of {strain:g} after {least:g} in unloading",
                          f"strain to shrink ({COLUMNS_HINT})")


def check_no_gap(test, turn):
    """Rows that are missing, round the peak above all, would leave another sand."""
    for column, (what, (part, of_few)) in enumerate([("strain", WIDEST_OF_STRAIN), ("pressure", WIDEST_OF_PRESSURE)]):
        widest = max(part, of_few / len(test.rows)) * test.rows[turn][column]
        for i, (row, next_row) in enumerate(zip(test.rows, test.rows[1:]), start=1):
            if abs(next_row[column] - row[column]) > widest:
                raise Refusal(f"{test.path}:{test.lines[i]}", f"a {what} of {next_row[column]:g} after {row[column]:g}",
                              f"no step wider than {widest:g} (are rows missing?)")


def check_branches(test, turn):
    """Enough of both, from and to about no pressure."""
    for what, branch in [("loading", loading_branch(test.rows)), ("unloading", unloading_branch(test.rows))]:
        if len(branch) < LEAST_ROWS:
            raise Refusal(test.path, f"{len(branch)} rows of {what}", f"{LEAST_ROWS} or more")
        if branch[0][1] > NEARLY_ZERO * test.rows[turn][1]:
            raise Refusal(test.path, f"{what} {'from' if what == 'loading' else 'to'} {branch[0][1]:g} Pa",
                          f"no pressure there, or less than {100 * NEARLY_ZERO:g} % of the largest")


def check_stiffness(place, elastic, pressure):
    """Check that the mean bulk modulus of an unloading, from a pressure over an elastic strain, is one of sand."""
    modulus, root = pressure / elastic, (pressure / AT_PRESSURE) ** 0.5
    softest, stiffest = SOFTEST * root, min(STIFFEST * root, STIFFEST_GRAINS)
    if not softest <= modulus <= stiffest:
        raise Refusal(place, f"unloading from {pressure:g} Pa with a bulk modulus of {modulus:g} Pa",
                      f"{softest:.2g} to {stiffest:.2g} Pa, as of sand (are the units right?)")


def check_together(tests):
    """Tests of one sand, in order of plastic strain; the last one loads furthest."""
    if len(tests) < 2:
        raise Refusal(tests[0].path, "one test", "two or more, unloaded from different strains")
    furthest = max(tests, key=lambda test: test.rows[turning_point(test.rows)][0])
    check_start(furthest)
    loading = loading_branch(furthest.rows)
    for test in tests:
        strain, pressure = test.rows[turning_point(test.rows)]
        expected = pressure_at(loading, strain)
        if not expected / 2 <= pressure <= 2 * expected:
            raise Refusal(test.path, f"{pressure:g} Pa at a strain of {strain:g}",
                          f"about {expected:g} Pa, as in the loading of {furthest.path}")
    for test, other in zip(tests, tests[1:]):
        check_apart(test, other)


def check_start(test):
    start, largest = test.rows[0][0], test.rows[turning_point(test.rows)][0]
    if abs(start) > NEARLY_ZERO * largest:
        raise Refusal(f"{test.path}:{test.lines[0]}", f"a strain of {start:g} at the start of the hydrostat",
                      "none: the sand as it was prepared")


def check_apart(test, other):
    curve, next_curve = unloading_curve(test.rows), unloading_curve(other.rows)
    pressure = crossing(curve, next_curve)
    if pressure is not None:
        raise Refusal(f"{test.path} and {other.path}", f"the unloading curves of plastic strain {curve[0]:g} and "
                      f"{next_curve[0]:g} meet or cross at {pressure:g} Pa",
                      "curves apart (noise, or the same test twice?)")
