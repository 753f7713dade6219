"""The page of plots: one HTML file with its figures inside. The same fits give the same file, byte for byte."""

import html
import io
import re

import matplotlib
import numpy as np

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.hashsalt": "fit_moduli", "svg.fonttype": "none", "font.size": 8, "axes.titlesize": 8,
    "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.2,
})  # fmt: skip
import matplotlib.pyplot as plt  # noqa: E402

N_ALONG = 81  # points of a drawn line
COLOURS = {"measured": "black", "SVR": "tab:orange", "MLP": "tab:blue"}

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 75em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; }
table { border-collapse: collapse; margin: 0.5em 0 1.5em; }
th, td { padding: 0.2em 0.9em; border-bottom: 1px solid #ccc; text-align: right; font-weight: normal; }
th { border-bottom-color: #666; vertical-align: bottom; max-width: 11em; }
svg { width: 100%; height: auto; }
"""


def write(path, curves, hydrostat, models, tables):
    parts = [
        section("Loading and unloading", OVERVIEW, overview(curves, hydrostat, models)),
        section("Pressure against elastic strain", PRESSURE, grid(curves, models, draw_pressure, "p [MPa]")),
        section("Residuals of pressure", RESIDUAL, grid(curves, models, draw_residual, "fit less measured [MPa]")),
        section("Bulk modulus against elastic strain", MODULUS, grid(curves, models, draw_modulus, "K [GPa]")),
        section("The same, logarithmic", "", grid(curves, models, draw_modulus, "K [GPa]", "log")),
        section("Errors", ERRORS, "\n".join(as_html(table) for table in tables)),
    ]
    title = "Fits of the elastic moduli"
    head = f'<meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
    body = "\n".join([f"<h1>{title}</h1>", *parts])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n')


OVERVIEW = """Total volumetric strain; all strains and pressures are positive in compression. The curves should start
on the axis in order of plastic strain and end on the hydrostat."""
PRESSURE = """Points are the rows of unloading.csv. The table model runs through them by a monotone cubic (black). The
SVR is counted from its pressure at zero elastic strain; the MLP is integrated from there."""
RESIDUAL = "The dotted lines are 1 % of the curve's largest pressure."
MODULUS = "Black is the slope of the monotone cubic: the table model."
ERRORS = """At evenly spaced strains along each curve. K and 1 - coupling / K must be positive: where the last is not,
plastic compaction at fixed total strain would raise the pressure, and the stress update has no single answer."""


def section(title, text, content):
    return f"<h2>{html.escape(title)}</h2>\n<p>{html.escape(text)}</p>\n{content}"


def overview(curves, hydrostat, models):
    figure, axes = plt.subplots(1, 2, figsize=(13, 4), layout="constrained")
    for axis, scale in zip(axes, ["linear", "log"]):
        axis.plot(hydrostat[:, 0], hydrostat[:, 1] / 1e6, color="grey", label="hydrostat")
        for i, curve in enumerate(curves):
            elastic = np.linspace(0, curve.end, N_ALONG)
            labels = [None] * (1 + len(models)) if i else ["measured", *(model.name for model in models)]
            axis.plot(elastic + curve.plastic, curve.pressure_at(elastic) / 1e6, color="black", label=labels[0])
            for model, label in zip(models, labels[1:]):
                pressure = model.at(elastic, curve.plastic)[0] / 1e6
                axis.plot(elastic + curve.plastic, pressure, "--", color=COLOURS[model.name], label=label)
        axis.set(xlabel="total volumetric strain", ylabel="p [MPa]", yscale=scale)
        axis.legend(frameon=False)
    axes[1].set_ylim(bottom=0.1)
    return as_svg(figure)


def grid(curves, models, draw, label, scale="linear"):
    """A panel a curve."""
    figure, axes = plt.subplots(1, len(curves), figsize=(13, 2.9), layout="constrained", squeeze=False)
    for axis, curve in zip(axes[0], curves):
        draw(axis, curve, models)
        axis.set(title=f"plastic strain {curve.plastic:.3f}", xlabel="elastic strain", yscale=scale)
        axis.locator_params(axis="x", nbins=4)
    axes[0, 0].set_ylabel(label)
    axes[0, 0].legend(frameon=False)
    return as_svg(figure)


def draw_pressure(axis, curve, models):
    elastic = np.linspace(0, curve.end, N_ALONG)
    axis.plot(curve.elastic, curve.pressure / 1e6, ".", color="grey", markersize=3)
    axis.plot(elastic, curve.pressure_at(elastic) / 1e6, color=COLOURS["measured"], label="measured")
    for model in models:
        axis.plot(elastic, model.at(elastic, curve.plastic)[0] / 1e6, color=COLOURS[model.name], label=model.name)


def draw_residual(axis, curve, models):
    elastic = np.linspace(0, curve.end, N_ALONG)
    bound = 0.01 * curve.pressure[-1] / 1e6
    for side in [-bound, bound]:
        axis.axhline(side, color="black", linestyle=":", linewidth=0.8)
    for model in models:
        residual = (model.at(elastic, curve.plastic)[0] - curve.pressure_at(elastic)) / 1e6
        axis.plot(elastic, residual, color=COLOURS[model.name], label=model.name)


def draw_modulus(axis, curve, models):
    elastic = np.linspace(0, curve.end, N_ALONG)
    axis.plot(elastic, curve.modulus_at(elastic) / 1e9, color=COLOURS["measured"], label="measured")
    for model in models:
        axis.plot(elastic, model.at(elastic, curve.plastic)[1] / 1e9, color=COLOURS[model.name], label=model.name)


def as_svg(figure):
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    # Within HTML the prologue of the XML is not wanted; a hundredth of a point is enough for lines.
    picture = text.getvalue()[text.getvalue().index("<svg") :]
    return re.sub(r' d="[^"]*"', lambda path: re.sub(r"(\.\d\d)\d+", r"\1", path[0]), picture)


def as_html(table):
    def row(tag, cells):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    rows = "\n".join([row("th", table.header), *(row("td", cells) for cells in table.rows)])
    return f"<h3>{html.escape(table.title)}</h3>\n<table>\n{rows}\n</table>"
