"""Figures 3 to 8: measurements of the concrete sand, and what the three models of its stiffness make of them."""

import csv
import pathlib
import tempfile

import numpy as np

from tamp import program, results
from tamp.charts import theme
from tamp.program import SAND
from tamp.research.report.drawing import COLOURS, chart, logarithmic
from tamp.research.report.numbers import Number, of

CRUSHED = 0.325  # p3, the plastic volumetric strain at which all pores are crushed
MEGA, GIGA, PERCENT = 1e6, 1e9, 0.01
BETWEEN = (0.0, 0.05, 0.1, 0.19, 0.26, 0.31)  # plastic strains between the measured curves
STRAIN, ELASTIC, PRESSURE = "total volumetric strain [%]", "elastic volumetric strain [%]", "pressure [MPa]"


def strength(columns):
    """q = sqrt(3 J2) of a yield table, whose heading says what its second column is."""
    return columns["q"] if "q" in columns else np.sqrt(3) * columns["sqrt_J2"]


def porosity(plastic):
    return np.maximum(CRUSHED - plastic, 0)


def asked(tamp, file, elastic, plastic):
    """(pressure, bulk modulus) of a model at some elastic strains and one plastic strain, by `tamp modulus`."""
    with tempfile.TemporaryDirectory() as folder:
        states, answers = pathlib.Path(folder) / "states.csv", pathlib.Path(folder) / "answers.csv"
        with open(states, "w", newline="") as made:
            rows = [[repr(float(strain)), repr(float(plastic))] for strain in elastic]
            csv.writer(made).writerows([["elastic_volumetric[-]", "plastic_volumetric[-]"], *rows])
        program.call(tamp, "modulus", file, "--states", states, "--out", answers)
        columns = results.columns(answers)
    names = ("p", "K") if "p" in columns else ("pressure", "bulk_modulus")
    return columns[names[0]], columns[names[1]]


def hue_of(curves, curve):
    return theme.hue(curves.index(curve) % len(theme.HUES))


def draw_data(album, curves):
    loading = results.columns(SAND / "hydrostat.csv")
    figure, axis = chart(STRAIN, PRESSURE)
    strain, pressure = loading["total_volumetric"] / PERCENT, loading["pressure"] / MEGA
    axis.plot(strain, pressure, color="#17b3c9", lw=2.4, label="loading")
    for curve in curves:
        axis.plot((curve.plastic + curve.elastic) / PERCENT, curve.pressure / MEGA, color=hue_of(curves, curve), lw=1.4,
                  label=f"unloading, plastic strain {curve.plastic / PERCENT:.1f} %")
    logarithmic(axis, "y", linear_below=10)
    axis.set_ylim(0, 1e4)
    axis.legend(fontsize=8)
    album.keep(figure, "03a", "Hydrostatic loading (cyan) and unloading of the dry, poorly graded concrete sand; the "
               "scale of pressure is logarithmic above 10 MPa.")

    figure, axis = chart(STRAIN, "bulk modulus [GPa], logarithmic")
    for curve in curves:
        fine = np.linspace(0, curve.end, 400)
        axis.plot((curve.plastic + fine) / PERCENT, curve.modulus_at(fine) / GIGA, color=hue_of(curves, curve),
                  label=f"plastic strain {curve.plastic / PERCENT:.1f} %")
    logarithmic(axis, "y")
    axis.legend(fontsize=8)
    album.keep(figure, "03b", "Bulk moduli: tangents to the unloading curves.")


def draw_strength(album):
    crush = results.columns(SAND / "crush_curve.csv")
    figure, axis = chart("plastic volumetric strain [%]", PRESSURE)
    axis.plot(crush["plastic_volumetric"] / PERCENT, crush["pressure"] / MEGA, color=COLOURS["table"], marker=".", ms=3)
    logarithmic(axis, "y")
    axis.set_ylim(1e-1, 2e4)
    album.keep(figure, "04a", "Crush curve: pressure of hydrostatic loading against plastic volumetric strain.")

    figure, axis = chart("pressure [MPa], logarithmic", "porosity p3 - plastic volumetric strain [%]")
    shown = crush["pressure"] > 0
    open_share = porosity(crush["plastic_volumetric"][shown]) / PERCENT
    axis.plot(crush["pressure"][shown] / MEGA, open_share, color=COLOURS["table"])
    logarithmic(axis, "x")
    axis.set_xlim(1e-1, 2e4)
    album.keep(figure, "04b", f"Crush curve as porosity, with p3 = {CRUSHED}.")

    table = results.columns(SAND / "yield.csv")
    figure, axis = chart("mean stress p [MPa]", "q = √(3 J₂) at yield [MPa]")
    axis.plot(table["pressure"] / MEGA, strength(table) / MEGA, color=COLOURS["table"], marker=".")
    album.keep(figure, "05", "Yield function of the report's sand, whose strength column is q.")


def draw_table(album, curves):
    figure, axis = chart("pressure [MPa], logarithmic", "bulk modulus [GPa], logarithmic")
    for curve in curves:
        fine = np.linspace(0, curve.end, 600)[1:]
        axis.plot(curve.pressure_at(fine) / MEGA, curve.modulus_at(fine) / GIGA, color=hue_of(curves, curve),
                  label=f"plastic strain {curve.plastic / PERCENT:.1f} %")
    logarithmic(axis, "x")
    logarithmic(axis, "y")
    axis.set_xlim(1e-1, 1e4)
    axis.legend(fontsize=8)
    album.keep(figure, "06", "Table: bulk modulus against pressure on each unloading curve. In between it is linear in "
               "plastic strain.")


def draw_fits(album, tamp, curves):
    figure, axis = chart(STRAIN, PRESSURE)
    axis.plot([], [], color=COLOURS["svr"], label="SVR")
    axis.plot([], [], "k.", ms=3, label="measured")
    for curve in curves:
        fine = np.linspace(0, curve.end, 200)
        pressure, _ = asked(tamp, SAND / "support_vectors.json", fine, curve.plastic)
        axis.plot((curve.plastic + fine) / PERCENT, pressure / MEGA, color=COLOURS["svr"])
        axis.plot((curve.plastic + curve.elastic) / PERCENT, curve.pressure / MEGA, "k.", ms=2)
    for plastic in BETWEEN:
        fine = np.linspace(0, 0.06, 100)
        pressure, _ = asked(tamp, SAND / "support_vectors.json", fine, plastic)
        axis.plot((plastic + fine) / PERCENT, pressure / MEGA, color=COLOURS["svr"], lw=0.6, alpha=0.6)
    axis.legend(fontsize=8)
    album.keep(figure, "07", "SVR: pressure against total volumetric strain, at the plastic strains of the measured "
               "unloading curves (thick) and between them (thin), as the fit gives it. Between curves it does not "
               "start at zero.")

    figure, axis = chart(ELASTIC, "bulk modulus [GPa], logarithmic")
    axis.plot([], [], color=COLOURS["mlp"], label="MLP")
    axis.plot([], [], "k", lw=0.8, ls=":", label="tangents to measured curves")
    for curve in curves:
        fine = np.linspace(0, curve.end, 300)
        _, modulus = asked(tamp, SAND / "network.h5", fine, curve.plastic)
        axis.plot(fine / PERCENT, modulus / GIGA, color=COLOURS["mlp"])
        axis.plot(fine / PERCENT, curve.modulus_at(fine) / GIGA, "k", lw=0.9, ls=":")
    for plastic in BETWEEN:
        fine = np.linspace(0, 0.13, 300)
        _, modulus = asked(tamp, SAND / "network.h5", fine, plastic)
        axis.plot(fine / PERCENT, modulus / GIGA, color=COLOURS["mlp"], lw=0.6, alpha=0.6)
    logarithmic(axis, "y")
    axis.legend(fontsize=8)
    album.keep(figure, "08", "MLP: bulk modulus against elastic volumetric strain at the measured plastic strains "
               "(thick) and between them (thin).")


def numbers(tamp):
    table, crush = results.columns(SAND / "yield.csv"), results.columns(SAND / "crush_curve.csv")
    q, number = strength(table), of()
    at_most, vertex = crush["plastic_volumetric"][-1] / PERCENT, table["pressure"][0] / 1e3
    found = [
        number("4", "plastic strain at the end of the crush curve", "%", at_most, "32.5"),
        number("5", "tension vertex of the yield function", "kPa", vertex, "shifted by 5"),
        number("5", "q at p = 0.9 GPa", "GPa", np.interp(0.9e9, table["pressure"], q) / GIGA, "0.82"),
        number("5", "q beyond p = 3 GPa", "GPa", q[-1] / GIGA, "1.0"),
    ]
    for model, file in (("Table", "unloading.csv"), ("SVR", "support_vectors.json"), ("MLP", "network.h5")):
        for plastic in (0.0, 0.0628):
            _, modulus = asked(tamp, SAND / file, [0.0], plastic)
            what = f"K at elastic strain 0, plastic strain {plastic / PERCENT:.2g} %"
            found.append(Number("6-8", what, model, "", "MPa", "", modulus[0] / MEGA))
    return found


def draw(album, tamp):
    from tamp.fit.curves import read_curves  # which needs scipy

    curves = read_curves(SAND / "unloading.csv")
    draw_data(album, curves)
    draw_strength(album)
    draw_table(album, curves)
    draw_fits(album, tamp, curves)
