"""The error budget: what each part of the error amounts to, stacked, a bar for each thing that has one."""

from tamp.charts.axes import Entry, Sheet, set_ticks, text_width, wrapped
from tamp.charts.chart import Table, make_chart
from tamp.charts.theme import HUES, LIGHT, Style, hue
from tamp.charts.formatting import counted, is_number, percent_text

ABOUT = """Amounts of all parts, one after the other, whatever their signs: how far the value may be off at worst.
Hatched parts have no bound: how much they amount to is not known, and the bar goes on beyond what is drawn."""
BAR, LINE, GAP = 24, 14, 14


def charts(study, quantity, prefix):
    bars = [{**b, "parts": b.get("parts", [])} for b in study.budgets if b.get("quantity") == quantity.name]
    if not bars:
        return []
    title = f"Error budget of {quantity.name}"
    return [make_chart(f"{prefix}-budget", title, describe(quantity, bars), ABOUT, table(quantity, bars),
                       lambda layout: draw(bars, quantity, title, layout))]


def amount_of(part):
    amount = part.get("amount")
    return abs(amount) if is_number(amount) else None


def amount_text(part):
    return "no bound" if amount_of(part) is None else percent_text(amount_of(part))


def total(bar):
    return sum(amount_of(part) or 0 for part in bar["parts"])


def without_bound(bar):
    return [part for part in bar["parts"] if amount_of(part) is None]


def draw(bars, quantity, title, layout):
    names = list(dict.fromkeys(part["name"] for bar in bars for part in bar["parts"]))
    colours = {name: hue(k, k // len(HUES)) for k, name in enumerate(names)}
    widest = max(map(total, bars)) or 0.01
    unknown = (0.07 if layout.labels_beside else 0.11) * widest
    limit = 1.04 * widest + unknown * max(len(without_bound(bar)) for bar in bars)
    legend = [entry_of(name, colour, bars) for name, colour in colours.items()]
    labels = [wrapped(label_of(bar, quantity), layout.width - 40, layout.font) for bar in bars]
    heights = [BAR + LINE * len(label) + GAP for label in labels]
    sheet = Sheet(layout, title, "", "relative to the value", legend, height=sum(heights) + 4)
    set_ticks(sheet.axis, "x", (0, limit), lambda tick: percent_text(tick, 2), logarithmic=False)
    sheet.axis.set(ylim=(0, sum(heights) + 4), yticks=[])
    top = sum(heights) + 4
    for bar, label, height in zip(bars, labels, heights):
        for k, line in enumerate(label):
            sheet.axis.annotate(line, (0, top - LINE * (k + 1)), (3, 0), textcoords="offset points", size=layout.font,
                                color=LIGHT["ink"])
        draw_bar(sheet, bar, colours, top - LINE * len(label) - BAR - 4, unknown)
        top -= height
    return sheet, []


def entry_of(name, colour, bars):
    unknown = [amount_of(part) is None for bar in bars for part in bar["parts"] if part["name"] == name]
    label = f"{name} (no bound)" if all(unknown) else f"{name} (hatched: no bound)" if any(unknown) else name
    return Entry(label, Style(colour), filled=True, hatch="////" if all(unknown) else "")


def label_of(bar, quantity):
    known = f"{bar.get('of', '')}, {quantity.value_text(bar.get('value'))}: {percent_text(total(bar))}"
    unknown = [part["name"] for part in without_bound(bar)]
    return f"{known}, and {' and '.join(unknown)} without a bound" if unknown else f"{known} in all"


def draw_bar(sheet, bar, colours, y, unknown):
    axis, font = sheet.axis, sheet.layout.font - 1
    scale = axis.bbox.width / axis.get_xlim()[1]
    x = 0
    for part in sorted(bar["parts"], key=lambda part: amount_of(part) is None):
        amount, colour = amount_of(part), colours[part["name"]]
        if amount is None:
            axis.barh(y, unknown, BAR, x, align="edge", facecolor=LIGHT["paper"], edgecolor=colour, hatch="////", lw=1)
            x += unknown
            continue
        axis.barh(y, amount, BAR, x, align="edge", facecolor=colour, edgecolor=LIGHT["paper"], lw=1)
        label = percent_text(amount, 2)
        if text_width(label, font) + 6 < amount * scale:
            axis.text(x + amount / 2, y + BAR / 2, label, ha="center", va="center_baseline", size=font,
                      color=LIGHT["paper"])
        x += amount


def describe(quantity, bars):
    sentences = [f"{counted(len(bars), 'bar')}."]
    for bar in bars:
        parts = [f"{part['name']} {amount_text(part)}" for part in bar["parts"]]
        sentences.append(f"{label_of(bar, quantity)} ({', '.join(parts)}).")
    return " ".join(sentences)


def table(quantity, bars):
    rows = []
    for bar in bars:
        for part in bar["parts"]:
            rows.append([bar.get("of", ""), quantity.value_text(bar.get("value")), part["name"], amount_text(part),
                         part.get("note", "")])
    return Table(["of", "value", "part", "amount", "how it was found"], rows)
