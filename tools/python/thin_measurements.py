#!/usr/bin/env python3
"""Make inputs/materials/concrete-sand/*.csv from the raw measurements.

    python3 tools/python/thin_measurements.py RAW_FOLDER [OUTPUT_FOLDER]

RAW_FOLDER holds measured/ (DrySand_LoadUnload_*.csv: strains in %, pressures in MPa) and vaango/
(DrySand_HydrostaticCapData.json, DrySand_YieldData.json). What is written is SI, compression positive, and thinned to as
few points as hold each curve within 0.1 %. Only the standard library is used.
"""

import argparse
import json
import pathlib

import unloading_from_tests as tests

SOURCE = [
    "Dry, poorly graded concrete sand: Fox et al. (2014), tested at the University of Maryland;",
    "S. Akers (CCDC Army Research Laboratory), private communication; as published with the Vaango code (MIT licence).",
    "Volumetric strains were measured as engineering ones, 1 - V/V0; the published tables take the same numbers as",
    "logarithmic ones. The material's key strain_measure says which. SI units, compression positive.",
    "Made by tools/python/thin_measurements.py.",
]


def vaango_table(path, x, y):
    data = json.loads(path.read_text())["Vaango_tabular_data"]["Data"]
    return tests.ascending(list(zip(data[x], data[y])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("raw", type=pathlib.Path, metavar="RAW_FOLDER")
    parser.add_argument("out", type=pathlib.Path, metavar="OUTPUT_FOLDER", nargs="?",
                        default="inputs/materials/concrete-sand")
    options = parser.parse_args()
    raw, out = options.raw, options.out
    out.mkdir(parents=True, exist_ok=True)

    def write(name, title, header, rows):
        tests.write(out / name, [title, *SOURCE], header, rows)

    paths = sorted((raw / "measured").glob("DrySand_LoadUnload_*.csv"))
    if not paths:
        parser.error(f"no measured/DrySand_LoadUnload_*.csv in {raw}")
    measured = [tests.measured(path, 100, 1e6) for path in paths]

    # The loading branch of the test to 45.20 %: the published hydrostat before its strains were cut to 0.01 %.
    loading = tests.thinned(tests.loading_branch(measured[-1]))
    write("hydrostat.csv", "Hydrostatic loading.", tests.HYDROSTAT_HEADER, loading)

    title = "Hydrostatic unloading, each curve from its own plastic strain."
    write("unloading.csv", title, tests.UNLOADING_HEADER, tests.unloading_rows(measured))

    header = "plastic_volumetric[-],pressure[Pa]"
    published = vaango_table(raw / "vaango" / "DrySand_HydrostaticCapData.json", "PlasticStrainVol", "Pressure")
    title = "Hydrostatic strength (crush curve), the published one."
    write("crush_curve.csv", title, header, tests.thinned(published))

    strength = vaango_table(raw / "vaango" / "DrySand_YieldData.json", "Pressure", "SqrtJ2")
    title = "Yield in triaxial compression; the first row is the tension vertex."
    # Measured is a "deviatoric yield stress", which is q; the published code reads the same numbers as sqrt(J2).
    write("yield.csv", title, "pressure[Pa],q[Pa]", tests.thinned(strength))
    write("yield_sqrt_J2.csv", title, "pressure[Pa],sqrt_J2[Pa]", tests.thinned(strength))


if __name__ == "__main__":
    main()
