"""Fits the models of the sand's elastic moduli to its measured unloading curves.

FOLDER holds unloading.csv, which is the table model itself, and hydrostat.csv; docs/how_to/fit_a_sand.md says how they
are made.
Written are support_vectors.json (SVR) and network.h5 (MLP), and if wanted a page of plots. The errors are printed. The
same input gives the same files, byte for byte. Debian's python3-sklearn, python3-h5py and python3-matplotlib are used.
"""

import pathlib

from tamp import files, made_files, markdown, program
from tamp.failure import Refusal, say
from tamp.fit import errors, network, page, support_vectors
from tamp.fit.curves import read_curves, read_hydrostat
from tamp.options import checked_number, count, positive

MOST_NEURONS = 4096  # of a layer; the published network has 64


def layers(text):
    """Neurons of each layer, as 64,32,32."""
    return tuple(neurons(number) for number in text.split(","))


part = checked_number(float, lambda value: 0 <= value < 1, "number from 0 to 1")
neurons = checked_number(int, lambda value: 1 <= value <= MOST_NEURONS, "number of neurons")
seed = checked_number(int, lambda value: 0 <= value < 2**32, "number from 0 to 4294967295")


def add_arguments(parser):
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER", help="for the files made; by default the same")
    parser.add_argument("--page", type=pathlib.Path, metavar="PAGE.html", help="plots of the fits")
    parser.add_argument("--c", type=positive, default=10, help="SVR: weight of errors (%(default)s)")
    parser.add_argument("--epsilon", type=part, default=0.001, help="SVR: free error, of the range of p (%(default)s)")
    parser.add_argument("--layers", type=layers, default="64,32,32", help="MLP: neurons of each (64,32,32)")
    parser.add_argument("--epochs", type=count, default=800, help="MLP (%(default)s)")
    parser.add_argument("--batch", type=count, default=32, help="MLP (%(default)s)")
    parser.add_argument("--seed", type=seed, default=1, help="MLP (%(default)s)")
    program.add_option(parser)


def check_with_tamp(tamp, made, curves):
    """Check that TAMP accepts the files: it is asked for states where the curves end."""
    ends = [(float(curve.end), float(curve.plastic)) for curve in curves]
    for file in made if tamp else []:
        objection = made_files.objection(tamp, file, ends)
        if objection:
            raise Refusal(objection + ", says TAMP")


def warn_of_softening(table):
    for name, least, *_ in table.rows:
        if float(least) <= 0:
            say(f"warning: {name} has a bulk modulus down to {least} GPa; expected one above 0, without which "
                "sand has no wave speed (another --c or --seed?)")


def main(options):
    sources = [options.folder / "unloading.csv", options.folder / "hydrostat.csv"]
    out = options.out or options.folder
    outputs = [out / "support_vectors.json", out / "network.h5"]
    files.keep_inputs(sources, outputs + ([options.page] if options.page else []))
    tamp = made_files.found(options.tamp)
    curves, hydrostat = read_curves(sources[0]), read_hydrostat(sources[1])
    check_with_tamp(tamp, sources[:1], curves)

    out.mkdir(parents=True, exist_ok=True)
    svr, mlp = map(made_files.aside, outputs)
    support_vectors.write(support_vectors.fit(curves, options.c, options.epsilon), svr)
    network.write(*network.fit(curves, options.epochs, options.batch, options.seed, options.layers), mlp)
    check_with_tamp(tamp, [svr, mlp], curves)
    made_files.put_in_place(outputs)

    # The page shows the models as the files have them.
    models = [support_vectors.SupportVectors(outputs[0]), network.Network(outputs[1])]
    print(f"support_vectors.json: {len(models[0].vectors)} vectors\n")
    tables = errors.tables(curves, hydrostat, models)
    for table in tables:
        print(table.title)
        markdown.print_table(table.head, table.rows)
    warn_of_softening(tables[-1])
    if options.page:
        page.write(options.page, curves, hydrostat, models, tables)
