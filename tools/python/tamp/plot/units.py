"""Units that a measured column may have, and what a number in one is in another."""

from tamp.charts.formatting import BASE_UNITS

# Besides those that charts know: the power of ten, and what it is of.
OTHERS = {
    "-": (0, ""), "1": (0, ""), "%": (-2, ""), "\u00b5m": (-6, "m"), "cm": (-2, "m"), "km": (3, "m"),
    "mm/s": (-3, "m/s"), "cm/s": (-2, "m/s"), "km/s": (3, "m/s"), "mN": (-3, "N"), "MN": (6, "N"),
    "kN m": (3, "N m"), "N mm": (-3, "N m"), "mJ": (-3, "J"), "MJ": (6, "J"), "g": (-3, "kg"), "t": (3, "kg")}
MICRO = str.maketrans("\u03bc", "\u00b5")  # the Greek letter to the sign


def parts(unit):
    unit = unit.strip().translate(MICRO)
    return OTHERS.get(unit) or BASE_UNITS.get(unit) or (0, unit)


def power_between(unit, wanted):
    """The power of ten by which a number in `unit` becomes one in `wanted`; None where it does not."""
    (power, base), (wanted_power, wanted_base) = parts(unit), parts(wanted)
    return power - wanted_power if base == wanted_base else None


def scaled(value, power):
    """12 mm are the double next to 0.012, which 12 / 1000 is and 12 * 0.001 need not be."""
    return value * 10**power if power >= 0 else value / 10**-power
