"""Holds the schema that `tamp schema` prints against the program: what it says of scenes, `tamp check` says too.

Every scene of inputs/ is accepted, as it stands and with every default filled in, and so are scenes with each kind of
key; the broken ones are refused by both, `tamp check` with exit code 2. It prints what differs, and the exit code is 1
if anything does. Debian's python3-jsonschema is used.
"""

import copy
import json
import pathlib
import tempfile

import jsonschema

from tamp import files, program
from tamp.program import INPUTS, ROOT, SAND

BOX = {"type": "box", "lower": [0, 0], "upper": [1, 1]}
PLANE = {
    "dimension": 2,
    "grid": {"upper": [9, 9], "cell_size": 1},
    "time": {"end": 1},
    "materials": {
        "steel": {"type": "hypoelastic", "density": 8000, "bulk_modulus": 10e9, "shear_modulus": 7e9},
        "iron": {"type": "neo_hookean", "density": 8000, "bulk_modulus": 10e9, "shear_modulus": 7e9}},
    "bodies": {"block": {"material": "steel", "geometry": BOX}}}

SPACE = copy.deepcopy(PLANE)
SPACE["dimension"] = 3
SPACE["grid"]["upper"] = [9, 9, 9]
SPACE["bodies"]["block"]["geometry"] = {"type": "box", "lower": [2, 2, 2], "upper": [4, 4, 4]}

CONCRETE_SAND = {"file": str(SAND / "table.json"), "density": 1050}
QUICK = {"file": str(INPUTS / "punch/quick.json")}
CYLINDER = {"type": "cylinder", "first_end": [3, 3, 2], "second_end": [3, 3, 5], "radius": 1}
LOG_SOLID = {"type": "neo_hookean_log", "bulk_modulus": 2e6, "shear_modulus": 3e6}
RING = {"type": "ring", "centre": [4, 4], "inner_radius": 1, "outer_radius": 2, "amplitude": 0.1}
DRIVEN = {"material": "steel", "rigid": True, "geometry": {"type": "box", "lower": [2, 2], "upper": [4, 4]}}

# A scene, and what is put where in it.
SOUND = [
    (PLANE, {"/title": "a block", "/gravity": None, "/centrifuge": None, "/$schema": "scene.schema.json"}),
    (PLANE, {"/grid/lower": [0, 0], "/grid/patches": [3, 1], "/particles_per_cell": [3, 3]}),
    (PLANE, {"/boundaries": {"x-": "open", "y-": {"friction": 0.4}, "y+": "no_slip"}}),
    (PLANE, {"/time": {"end": 1, "rule": "published", "multiplier": 1, "minimum_step": 1e-9, "maximum_step": 0.1}}),
    (PLANE, {"/interpolator": "quadratic_spline", "/transfer": "tflip", "/local_damping": 0.5}),
    (PLANE, {"/interpolator": "linear", "/time/rule": "published", "/time/multiplier": 1.5}),
    (PLANE, {"/interpolator": "cpdi"}),
    (PLANE, {"/deformation_update": "first_order", "/anti_locking": "f_bar"}),
    (SPACE, {"/deformation_update": "exponential", "/anti_locking": "cell_average", "/stress_timing": "musl"}),
    (PLANE, {"/transfer": "affine", "/relief": "f_bar"}),
    (PLANE, {"/artificial_viscosity": {}, "/limits": {"energy_error": "off"}, "/failed_updates_allowed": 3}),
    (PLANE, {"/output": {"fields_interval": 0.5, "history_interval": 0.1, "near_nose": 0.2}}),
    (PLANE, {"/contact": [{"materials": ["steel", "iron"], "friction": 0.1, "normal": "iron"}]}),
    (PLANE, {"/contact": [{"materials": ["steel", "iron"], "friction": 0, "normal": "regression"}]}),
    (PLANE, {"/materials/iron/particles_per_axis": 3, "/bodies/block/velocity": [0, 1]}),
    (PLANE, {"/bodies/block/angular_velocity": [1], "/bodies/block/nose": [0, 0], "/bodies/block/tail": [1, 1]}),
    (PLANE, {"/bodies/block": DRIVEN, "/bodies/block/driven": {"velocity": [0, 1]}}),
    (PLANE, {"/bodies/block": DRIVEN, "/bodies/block/driven": {"velocities": [[0, 0, 1]], "rotation": "free"}}),
    (PLANE, {"/bodies/block": DRIVEN, "/bodies/block/driven": {"displacements": [[0, 0, 0], [1, 0, 1]]}}),
    (PLANE, {"/bodies/block/geometry": {"type": "polygon", "corners": [[1, 1], [3, 1], [1, 3]]}}),
    (PLANE, {"/bodies/block/geometry": {"type": "transform", "of": {"title": "a box", **BOX}, "rotation": {"angle": 90},
                                        "translation": [2, 2]}}),
    (PLANE, {"/materials/soil": {"type": "drucker_prager", "density": 1600, "bulk_modulus": 2e7, "shear_modulus": 1e7,
                                 "friction_angle": 30, "cohesion": 1e3}}),
    (PLANE, {"/materials/sand": CONCRETE_SAND}),
    (PLANE, {"/materials/sand": {**CONCRETE_SAND, "modulus": {"compile": 0.01}, "tolerance": 1e-4}}),
    (PLANE, {"/materials/sand": {**CONCRETE_SAND, "separation": True, "separation_density": 0.7}}),
    (PLANE, {"/materials/sand": {**CONCRETE_SAND, "comes_apart": True}}),
    (PLANE, {"/materials/sand": {"file": CONCRETE_SAND["file"], "type": "hypoelastic", "density": 1,
                                 "bulk_modulus": 1e7,
                                 "shear_modulus": 1e7, "poisson_ratio": None, "modulus": None, "yield": None,
                                 "hydrostat": None, "elastic_update": None, "strain_measure": None,
                                 "tested_strain": None,
                                 "tested_density": None, "crush_curve": None}}),
    (SPACE, {"/boundaries": {"z+": "open"}, "/bodies/block/angular_velocity": [0, 0, 1]}),
    (SPACE, {"/centrifuge": {"angular_speed": 6, "axis": [1, 0, 0], "centre": [0, 0, 5], "angular_acceleration": 1}}),
    (SPACE, {"/bodies/block/geometry": {
        "type": "union", "of": [CYLINDER, {"type": "ball", "centre": [4, 4, 4], "radius": 1}]}}),
    (SPACE, {"/bodies/block/geometry": {"type": "transform", "translation": [4, 4, 4], "of": {
        "type": "ring", "count": 3, "axis": [0, 0, 1],
        "of": {"type": "box", "lower": [1, 0, 0], "upper": [3, 1, 1]}}}}),
    (SPACE, {"/bodies/block/geometry": {
        "type": "extruded_polygon", "corners": [[1, 1], [3, 1], [1, 3]], "lower": 1, "upper": 3}}),
    (SPACE, {"/bodies/block/geometry": {
        "type": "revolved", "start": [4, 4, 2], "axis": [0, 0, 1], "profile": [[0, 1], [3, 1]]}}),
    (PLANE, {"/boundaries": {"y-": "periodic", "y+": "periodic"}, "/output": {"fields": ["p", "nodes/velocity"]}}),
    (PLANE, {"/bodies/block/pressure": {"values": [[0, 0], [1, 1e5]]}}),
    (PLANE, {"/materials/steel": {**LOG_SOLID, "density": 1000}, "/bodies/block/problem": {**RING, "on_rings": False},
             "/bodies/block/geometry": {"type": "box", "lower": [5, 3], "upper": [6, 5]}}),
    (QUICK, {"/materials": {"sand": {"modulus": {"type": "svr"}}}, "/artificial_viscosity": None}),
    (QUICK, {"/time": {"end": 1e-3}, "/bodies": {"punch": {"velocity": [0, -100]}}}),
]

BROKEN = [
    # of a wrong type
    (PLANE, {"/time/end": "soon"}),
    (PLANE, {"/title": 3}),
    (PLANE, {"/dimension": 2.5}),
    (PLANE, {"/contact": {}}),
    (PLANE, {"/contact": [1]}),
    (PLANE, {"/bodies/block/rigid": 1}),
    (PLANE, {"/boundaries": []}),
    (PLANE, {"/bodies/block/driven": [0, 1]}),
    # out of range
    (PLANE, {"/dimension": 4}),
    (PLANE, {"/time/end": 0}),
    (PLANE, {"/time/multiplier": 101}),
    (PLANE, {"/grid/patches": [0, 1]}),
    (PLANE, {"/particles_per_cell": [17, 17]}),
    (PLANE, {"/local_damping": 1}),
    (PLANE, {"/materials/steel/density": -8000}),
    (PLANE, {"/materials/steel/particles_per_axis": 0}),
    (PLANE, {"/boundaries": {"x-": {"friction": -0.1}}}),
    (PLANE, {"/limits": {"energy_error": 0}}),
    (PLANE, {"/bodies/block/geometry": {"type": "ball", "centre": [1, 1], "radius": 0}}),
    (SPACE, {"/centrifuge": {"angular_speed": -6, "axis": [1, 0, 0], "centre": [0, 0, 5]}}),
    # unknown keys
    (PLANE, {"/gravty": [0, 0]}),
    (PLANE, {"/grid/cellsize": 1}),
    (PLANE, {"/materials/steel/poisson_ratio": 0.3}),
    (PLANE, {"/bodies/block/geometry/radius": 1}),
    (PLANE, {"/bodies/block/driven": {"speed": 1}}),
    (PLANE, {"/boundaries": {"x": "open"}}),
    (PLANE, {"/output": {"fields_intervall": None}}),
    # missing keys
    (PLANE, {"/dimension": None}),
    (PLANE, {"/grid/cell_size": None}),
    (PLANE, {"/bodies/block/material": None}),
    (PLANE, {"/bodies/block/geometry": {"lower": [0, 0], "upper": [1, 1]}}),
    (PLANE, {"/bodies": {}}),
    (PLANE, {"/materials/steel/shear_modulus": None}),
    (SPACE, {"/bodies/block/geometry": {"type": "cylinder", "first_end": [3, 3, 2], "radius": 1}}),
    # wrong words and names
    (PLANE, {"/time/rule": "fast"}),
    (PLANE, {"/interpolator": "quintic_spline"}),
    (PLANE, {"/boundaries": {"x-": "wall"}}),
    (PLANE, {"/materials/steel/type": "hypoelastik"}),
    (PLANE, {"/limits": {"energy_error": "none"}}),
    (PLANE, {"/bodies/a.b": {"material": "steel", "geometry": BOX}}),
    (SPACE, {"/bodies/block/geometry/type": "bal"}),
    # wrong numbers of entries
    (PLANE, {"/gravity": [0]}),
    (PLANE, {"/gravity": [0, 0, 0, -9.81]}),
    (PLANE, {"/bodies/block/angular_velocity": [1, 2, 3, 4]}),
    (PLANE, {"/contact": [{"materials": ["steel"], "friction": 0}]}),
    (PLANE, {"/bodies/block": DRIVEN, "/bodies/block/driven": {"velocities": [[0, 1]]}}),
    (PLANE, {"/materials/sand": {**CONCRETE_SAND, "modulus": {"scaling": [1, 2]}}}),
    # in what bodies may have
    (PLANE, {"/bodies/block/pressure": {"value": -1}}),
    (PLANE, {"/bodies/block/pressure": {"values": [[0, 0, 1]]}}),
    (PLANE, {"/bodies/block/pressure": {"value": 1, "within": {"lower": [0, 0]}}}),
    (PLANE, {"/bodies/block/problem": {"type": "axis_aligned", "amplitude": 0.1, "length": 1}}),
    (PLANE, {"/bodies/block/problem": {"type": "swinging_bar"}}),
    (PLANE, {"/bodies/block/problem": {**RING, "on_rings": 1}}),
    (PLANE, {"/output": {"fields": "p"}}),
    # in scenes and materials that name another
    (QUICK, {"/time": {"ende": 1}}),
    (QUICK, {"/materials": {"sand": {"modulus": {"type": "svm"}}}}),
    (QUICK, {"/bodies": {"punch": {"velocity": ["down"]}}}),
    (QUICK, {"/file": 1}),
    (PLANE, {"/materials/sand": {**CONCRETE_SAND, "poisson_ratio": 0.5}}),
    (PLANE, {"/materials/sand": {**CONCRETE_SAND, "strength": 30}}),
]


def scene_with(base, values):
    scene = copy.deepcopy(base)
    for pointer, value in values.items():
        *above, key = pointer.split("/")[1:]
        place = scene
        for name in above:
            place = place[name]
        place[key] = value
    return copy.deepcopy(scene)


class Both:
    """The schema and the program, asked for the same files."""

    def __init__(self, tamp):
        self.tamp = tamp
        schema = json.loads(program.call(tamp, "schema").stdout)
        jsonschema.Draft7Validator.check_schema(schema)
        self.validator = jsonschema.Draft7Validator(schema)
        self.definitions = {name: jsonschema.Draft7Validator({**schema, "allOf": [{"$ref": f"#/definitions/{name}"}]})
                            for name in ("material", "solid")}
        self.n_wrong = 0

    def report(self, problem):
        self.n_wrong += 1
        print(problem)

    def expect_accepted(self, name, value, validator=None):
        for error in (validator or self.validator).iter_errors(value):
            place = "/".join(map(str, error.absolute_path))
            self.report(f"{name}: the schema refuses {place}: {error.message[:200]}")

    def expect_sound(self, name, file):
        self.expect_accepted(name, files.document(file))
        checked = program.answer(self.tamp, "check", file, "--json", "--no-trial")
        if checked.returncode != 0:
            self.report(f"{name}: `tamp check` ends with {checked.returncode}: {checked.stderr}")
            return
        self.expect_accepted(f"{name}, as resolved", json.loads(checked.stdout))

    def expect_broken(self, name, file):
        if self.validator.is_valid(files.document(file)):
            self.report(f"{name}: the schema accepts it")
        checked = program.answer(self.tamp, "check", file, "--no-trial")
        if checked.returncode != 2:
            self.report(f"{name}: `tamp check` ends with {checked.returncode}")


def is_scene(file):
    """Neither a material nor a solid, nor a study or what it names; but for the scenes of studies."""
    if "studies" in file.parts or file.parent.name in ("verification", "stability"):
        return file.parent.name == "scenes"
    return "materials" not in file.parts and not file.name.startswith("projectile")


def add_arguments(parser):
    program.add_option(parser)


def main(options):
    both = Both(options.tamp)

    shipped = [file for file in sorted(INPUTS.rglob("*.json")) if is_scene(file)]
    for file in shipped:
        both.expect_sound(file.relative_to(ROOT), file)
    for kind, pattern in (("material", "materials/*/*.json"), ("solid", "uxo/projectile*.json")):
        for file in sorted(INPUTS.glob(pattern)):
            if file.name != "support_vectors.json":
                both.expect_accepted(file.relative_to(ROOT), files.document(file), both.definitions[kind])

    with tempfile.TemporaryDirectory() as folder:
        for expect, scenes in ((both.expect_sound, SOUND), (both.expect_broken, BROKEN)):
            for base, values in scenes:
                file = pathlib.Path(folder) / "scene.json"
                file.write_text(json.dumps(scene_with(base, values)))
                expect(f"a scene with {json.dumps(values)}", file)

    print(f"{len(shipped)} scenes of inputs/, {len(SOUND)} sound and {len(BROKEN)} broken ones; "
          f"{both.n_wrong} not as expected")
    return 1 if both.n_wrong or not shipped else 0
