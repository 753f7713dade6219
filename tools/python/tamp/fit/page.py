"""The page of plots: one HTML file with its figures inside. The same fits give the same file, byte for byte."""

import numpy as np

from tamp.charts import page, picture
from tamp.charts.chart import Table
from tamp.charts.theme import LIGHT, hue, matplotlib
from tamp.charts.formatting import counted, escaped

matplotlib.rcParams.update({
    "font.size": 8, "axes.titlesize": 8, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.2,
    "text.color": LIGHT["ink"], "axes.labelcolor": LIGHT["ink"], "axes.edgecolor": LIGHT["faint"],
    "xtick.color": LIGHT["faint"], "ytick.color": LIGHT["faint"], "xtick.labelcolor": LIGHT["ink"],
    "ytick.labelcolor": LIGHT["ink"], "text.parse_math": True,
})
import matplotlib.pyplot as plt  # noqa: E402

N_ALONG = 81  # points of a drawn line
COLOURS = {"measured": LIGHT["ink"], "SVR": hue(1), "MLP": hue(0)}


def write(path, curves, hydrostat, models, tables):
    def panels(*how):
        return grid(curves, models, *how)

    figures = [
        ("Loading and unloading", OVERVIEW, overview(curves, hydrostat, models)),
        ("Pressure against elastic strain", PRESSURE, panels(draw_pressure, "p [MPa]")),
        ("Residuals of pressure", RESIDUAL, panels(draw_residual, "fit less measured [MPa]")),
        ("Bulk modulus against elastic strain", MODULUS, panels(draw_modulus, "K [GPa]")),
        ("The same, logarithmic", "", panels(draw_modulus, "K [GPa]", "log")),
    ]
    strains = ", ".join(f"{curve.plastic:.3f}" for curve in curves)
    shown = (f"{counted(len(curves), 'unloading curve')} at plastic strains {strains}, measured and fitted; "
             "errors stand below.")
    content = ""
    for k, (title, text, figure) in enumerate(figures):
        content += section(title, text, as_svg(figure, f"figure-{k + 1}", title, shown))
    content += section("Errors", ERRORS, "\n".join(map(as_html, tables)))
    title = "Fits of the elastic moduli"
    path.parent.mkdir(parents=True, exist_ok=True)
    content = f"<main>\n<h1>{title}</h1>\n{content}</main>\n"
    path.write_text(page.whole_page(title, content, kind="fit"), encoding="utf-8")


OVERVIEW = """Total volumetric strain; all strains and pressures are positive in compression. The curves should start
on the axis in order of plastic strain and end on the hydrostat."""
PRESSURE = """\
Points are the rows of unloading.csv. The table model runs through them by a monotone cubic (measured). The
SVR is counted from its pressure at zero elastic strain; the MLP is integrated from there."""
RESIDUAL = "The dotted lines are 1 % of the curve's largest pressure."
MODULUS = "Measured is the slope of the monotone cubic: the table model."
ERRORS = """At evenly spaced strains along each curve. K and 1 - coupling / K must be positive: where the last is not,
plastic compaction at fixed total strain would raise the pressure, and the stress update has no single answer."""


def section(title, text, content):
    return f"<h2>{escaped(title)}</h2>\n" + (f"<p>{escaped(text)}</p>\n" if text else "") + content


def overview(curves, hydrostat, models):
    figure, axes = plt.subplots(1, 2, figsize=(13, 4), layout="constrained")
    for axis, scale in zip(axes, ["linear", "log"]):
        axis.plot(hydrostat[:, 0], hydrostat[:, 1] / 1e6, color=LIGHT["faint"], label="hydrostat")
        for i, curve in enumerate(curves):
            elastic = np.linspace(0, curve.end, N_ALONG)
            labels = [None] * (1 + len(models)) if i else ["measured", *(model.name for model in models)]
            axis.plot(elastic + curve.plastic, curve.pressure_at(elastic) / 1e6, color=COLOURS["measured"],
                      label=labels[0])
            for model, label in zip(models, labels[1:]):
                pressure = model.at(elastic, curve.plastic)[0] / 1e6
                axis.plot(elastic + curve.plastic, pressure, "--", color=COLOURS[model.name], label=label)
        axis.set(xlabel="total volumetric strain", ylabel="p [MPa]", yscale=scale)
        axis.legend(frameon=False)
    axes[1].set_ylim(bottom=0.1)
    return figure


def grid(curves, models, draw, label, scale="linear"):
    """A panel a curve."""
    figure, axes = plt.subplots(1, len(curves), figsize=(13, 2.9), layout="constrained", squeeze=False)
    for axis, curve in zip(axes[0], curves):
        draw(axis, curve, models)
        axis.set(title=f"plastic strain {curve.plastic:.3f}", xlabel="elastic strain", yscale=scale)
        axis.locator_params(axis="x", nbins=4)
    axes[0, 0].set_ylabel(label)
    axes[0, 0].legend(frameon=False)
    return figure


def draw_pressure(axis, curve, models):
    elastic = np.linspace(0, curve.end, N_ALONG)
    axis.plot(curve.elastic, curve.pressure / 1e6, ".", color=LIGHT["faint"], markersize=3)
    axis.plot(elastic, curve.pressure_at(elastic) / 1e6, color=COLOURS["measured"], label="measured")
    for model in models:
        axis.plot(elastic, model.at(elastic, curve.plastic)[0] / 1e6, color=COLOURS[model.name], label=model.name)


def draw_residual(axis, curve, models):
    elastic = np.linspace(0, curve.end, N_ALONG)
    bound = 0.01 * curve.pressure[-1] / 1e6
    for side in [-bound, bound]:
        axis.axhline(side, color=COLOURS["measured"], linestyle=":", linewidth=0.8)
    for model in models:
        residual = (model.at(elastic, curve.plastic)[0] - curve.pressure_at(elastic)) / 1e6
        axis.plot(elastic, residual, color=COLOURS[model.name], label=model.name)


def draw_modulus(axis, curve, models):
    elastic = np.linspace(0, curve.end, N_ALONG)
    axis.plot(elastic, curve.modulus_at(elastic) / 1e9, color=COLOURS["measured"], label="measured")
    for model in models:
        axis.plot(elastic, model.at(elastic, curve.plastic)[1] / 1e9, color=COLOURS[model.name], label=model.name)


def as_svg(figure, name, title, description):
    svg = picture.within_page(picture.as_picture(figure, name, title, description))
    plt.close(figure)
    return page.wide(f'<div class="sheet">\n{svg}</div>', escaped(title))


def as_html(table):
    return f"<h3>{escaped(table.title)}</h3>\n{page.as_html(Table(table.head, table.rows))}"
