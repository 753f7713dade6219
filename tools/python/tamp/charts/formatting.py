"""Numbers as people read them: three digits, with SI prefixes or in percent; text that cannot be taken for markup."""

import html
import math

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
# Units that take a prefix, and the power of ten of those that have one already.
BASE_UNITS = {unit: (0, unit) for unit in ["", "s", "m", "Pa", "N", "J", "W", "Hz", "m/s", "B", "N/m", "J/m"]} | {
    "ns": (-9, "s"), "us": (-6, "s"), "µs": (-6, "s"), "ms": (-3, "s"), "um": (-6, "m"), "mm": (-3, "m"),
    "kPa": (3, "Pa"), "MPa": (6, "Pa"), "GPa": (9, "Pa"), "kN": (3, "N"), "kJ": (3, "J")}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
NO_NUMBER = "–"


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def number_text(value, digits=3):
    """A number as text, such as 0.0312, 48 200 or 1.2×10⁻⁷."""
    if not is_number(value):
        return NO_NUMBER
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    exponent = int(exponent)
    if -4 <= exponent < 6:
        text = f"{float(f'{mantissa}e{exponent}'):,.{max(digits - 1 - exponent, 0)}f}".replace(",", "\u202f")
        return without_zeros(text).replace("-", "−")
    power = f"10{str(exponent).translate(SUPERSCRIPTS)}"
    mantissa = without_zeros(mantissa).replace("-", "−")
    return {"1": power, "−1": "−" + power}.get(mantissa, f"{mantissa}×{power}")


def without_zeros(text):
    return text.rstrip("0").rstrip(".") if "." in text else text


def si_text(value, unit, digits=3):
    """A quantity as text, such as 312 µs; units that take no prefix, such as deg, stand behind the plain number."""
    if not is_number(value):
        return NO_NUMBER
    unit = "" if unit == "-" else unit
    if unit not in BASE_UNITS or value == 0:
        return f"{number_text(value, digits)} {unit}".strip()
    power, base = BASE_UNITS[unit]
    # A number that rounds to 1000 has the next prefix already; so the exponent is that of the rounded number.
    exponent = int(f"{value:.{digits - 1}e}".split("e")[1]) + power
    prefix = min(max(exponent - exponent % 3, -12), 12)
    # A plain number needs no letter that says milli.
    if base == "" and prefix < 3:
        return number_text(value * 10**power, digits)
    return f"{number_text(value * 10.0 ** (power - prefix), digits)} {PREFIXES[prefix]}{base}".strip()


def percent_text(value, digits=3):
    return f"{number_text(100 * value, digits)} %" if is_number(value) else NO_NUMBER


def counted(n, one, many=None):
    """1 point, 2 points."""
    return f"{n} {one if n == 1 else many or one + 's'}"


def shortened(text, n_most):
    return text if len(text) <= n_most else text[: max(n_most - 1, 1)].rstrip() + "…"


def escaped(text):
    return html.escape(str(text), quote=True)


def plain(value):
    """A JSON value whose texts have no characters that XML cannot hold."""
    if isinstance(value, str):
        return "".join(c for c in value
                       if c in "\n\t" or " " <= c < "\ud800" or "\ue000" <= c < "\ufffe" or c > "\uffff")
    if isinstance(value, list):
        return [plain(inner) for inner in value]
    if isinstance(value, dict):
        return {plain(key): plain(inner) for key, inner in value.items()}
    return value
