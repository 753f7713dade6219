"""What the page of a run shows of its sand: pictures at the greatest force, and a slider over time."""

import base64
import io
import json
import pathlib
import re
import tempfile
import unittest

import numpy as np
from PIL import Image

from tamp.charts import laid_over, movie, run_history, run_page, sand, sand_charts, shades
from tamp.charts.raster import NOBODY, Raster
from tests.page_tags import Tags

try:
    import h5py
except ModuleNotFoundError:
    h5py = None

AXES = [{"name": "x", "lower": 0, "upper": 1}, {"name": "y", "lower": 0, "upper": 0.5}]
FIELDS = ("p", "density", "plastic_volumetric")


def lattice(n):
    """n across, half as many upwards."""
    x, y = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n // 2) + 0.5) / n)
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])


def write_material(file, step, time, name, position, **values):
    group = file.require_group(step)
    group.attrs["time"] = time
    material = group.create_group(f"particles/{name}")
    material["id"] = np.arange(len(position))
    material["position"] = position
    for field, numbers in values.items():
        material[field] = np.broadcast_to(np.asarray(numbers, float), len(position))


def write_fields(path, n=40, n_outputs=5, fields=FIELDS):
    """Sand whose p grows with time and with x, below a rigid body at the upper left."""
    with h5py.File(path, "w") as file:
        for k in range(n_outputs):
            step, position = f"step_{k:08d}", lattice(n)
            values = {"p": 1e3 * k * (1 + position[:, 0]), "density": 1600 + 10 * k + 5 * position[:, 1],
                      "plastic_volumetric": 0.001 * k * (position[:, 0] - 0.5)}
            in_sand = (position[:, 0] > 0.25) | (position[:, 1] < 0.25)
            write_material(file, step, 1e-3 * k, "sand", position[in_sand],
                           **{field: values[field][in_sand] for field in fields})
            write_material(file, step, 1e-3 * k, "steel", position[~in_sand], p=0)


def history_of(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "history.csv")
        path.write_text(text)
        return run_history.History(path)


HISTORY = ("time[s],punch.depth[m],punch.contact_force_x[N],punch.contact_force_y[N],sand.p_max[Pa],"
           "sand.plastic_volumetric_max[-]\n0,0,0,0,0,0\n0.0011,0.1,0,900,4,0\n0.0019,0.2,3000,4000,5,0\n"
           "0.0029,0.3,nan,nan,7,0\n0.004,0.3,0,1000,6,0\n")


def run_in(folder, slab=None, history=HISTORY, dimension=2):
    return {"folder": pathlib.Path(folder), "history": history_of(history),
            "page": {"materials": ["steel", "sand"], "pictures": [{"axes": AXES, "slab": slab}]},
            "scene": {"dimension": dimension, "axisymmetric": False, "particles_per_cell": [2, 2],
                      "grid": {"cell_size": 0.05}, "materials": {"steel": {}, "sand": {}},
                      "bodies": {"punch": {"material": "steel", "rigid": True},
                                 "ground": {"material": "sand", "rigid": False}}}}


def read(folder, **how):
    return sand.read(sand.wanted(run_in(folder, **how)))


class InAFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)


class TheReach(unittest.TestCase):
    def test_of_particles_on_rings_leaves_no_hole_in_a_disk(self):
        scene = {"particles_per_cell": [2, 2], "grid": {"cell_size": 1}, "materials": {"steel": {}},
                 "bodies": {"ball": {"material": "steel", "particles": "rings"}}}
        raster = Raster([0, 0], [8, 8], 400, [])
        for ring in range(12):
            n = max(round(2 * np.pi * (ring + 0.5)), 4)
            angles = 2 * np.pi * (np.arange(n) + 0.5) / n
            places = 4 + 0.5 * (ring + 0.5) * np.column_stack([np.cos(angles), np.sin(angles)])
            raster.add(places, sand.reach_of(scene, "steel"), np.zeros(n), 0, {})
        y, x = np.mgrid[0:400, 0:400]
        inside = np.hypot(x + 0.5 - 200, y + 0.5 - 200) < 180

        self.assertTrue(np.all(raster.rows(raster.kind)[inside] == 0))
        self.assertLess(sand.reach_of({**scene, "bodies": {}}, "steel"), sand.reach_of(scene, "steel"))


class TheRaster(unittest.TestCase):
    def test_gives_each_square_the_nearest_particle_that_reaches_it(self):
        random = np.random.default_rng(5)
        places, off, values = random.uniform(-0.1, 1.1, (300, 2)), random.uniform(0, 0.05, 300), np.arange(300.0)
        raster, reach = Raster([0, 0], [1, 1], 20, ["p"]), 0.07

        raster.add(places, reach, off, 3, {"p": values})

        for row in range(20):
            for column in range(20):
                aside = np.abs((np.array([column, row]) + 0.5) / 20 - places)
                distance = np.where(aside.max(axis=1) <= reach, (aside**2).sum(axis=1) + off**2, np.inf)
                nearest = int(np.argmin(distance))
                found = raster.rows(raster.value["p"])[row, column]
                if np.isinf(distance[nearest]):
                    self.assertEqual(raster.rows(raster.kind)[row, column], NOBODY)
                else:
                    self.assertAlmostEqual(distance[int(found)], distance[nearest], places=6)

    def test_is_the_same_whichever_material_comes_first(self):
        made = []
        for order in [(0, 1), (1, 0)]:
            raster = Raster([0, 0], [3, 1], 12, ["p"])
            for kind in order:
                raster.add(np.array([[0.4 + kind, 0.5]]), 0.6, np.zeros(1), kind, {"p": np.array([float(kind)])})
            made.append(raster.rows(raster.kind))

        np.testing.assert_array_equal(*made)
        self.assertEqual({0, 1, NOBODY} & set(made[0].ravel().tolist()), {0, 1, NOBODY})

    def test_has_a_square_where_particles_are_smaller_and_none_for_what_is_no_number(self):
        raster = Raster([0, 0], [1, 1], 4, ["p"])

        raster.add(np.array([[0.1, 0.9], [np.nan, 0.5], [1e300, 0]]), 1e-9, np.zeros(3), 0, {"p": np.ones(3)})

        self.assertEqual(np.argwhere(raster.rows(raster.kind) == 0).tolist(), [[3, 0]])


class TheMoment(unittest.TestCase):
    SCENE = {"dimension": 3, "axisymmetric": False}

    def test_is_that_of_the_greatest_contact_force_in_all_directions(self):
        found = run_history.greatest(history_of(HISTORY), self.SCENE, ["sand"])

        self.assertEqual((found.kind, found.time), ("force", 0.0019))
        self.assertEqual(found.text, "the greatest contact force on punch, 5 kN at 1.9 ms")
        self.assertEqual(found.at(0.0011), 900)

    def test_of_a_plane_scene_has_a_force_per_metre(self):
        found = run_history.greatest(history_of(HISTORY), {**self.SCENE, "dimension": 2}, ["sand"])

        self.assertIn("5 kN/m", found.text)

    def test_is_that_of_the_largest_p_without_a_force_and_of_nothing_without_both(self):
        still = "time[s],a.contact_force_x[N],sand.p_max[Pa]\n0,0,0\n0.1,0,30\n0.2,0,30\n0.3,0,nan\n"
        found = run_history.greatest(history_of(still), self.SCENE, ["sand"])

        self.assertEqual((found.kind, found.time), ("pressure", 0.1))
        self.assertEqual(found.text, "the largest p of sand, 30 Pa at 100 ms")
        self.assertIsNone(run_history.greatest(history_of(still), self.SCENE, ["mud"]))

    def test_is_not_shown_by_the_output_of_the_start_where_there_is_another(self):
        moment = run_history.Moment("force", 1e-5, "", "", "N", None)

        self.assertEqual(sand.nearest(np.array([0, 0.1, 0.2]), moment), 1)
        self.assertEqual(sand.nearest(np.array([0.0]), moment), 0)
        self.assertEqual(sand.nearest(np.array([0, 0.1, 0.2]), None), 2)


class TheOutputs(unittest.TestCase):
    def test_that_are_shown_have_the_first_the_last_and_the_greatest_force_among_them(self):
        for n, peak, n_each in [(1, 0, 9), (2, 1, 9), (60, 31, 10), (500, 333, 50_000), (100, 7, 10**6),
                                (1000, 998, 10**9)]:
            chosen = sand.chosen_outputs(n, peak, n_each)

            self.assertLessEqual({0, peak, n - 1}, set(chosen))
            self.assertEqual(chosen, sorted(set(chosen)))
            self.assertLessEqual(len(chosen), min(n, sand.MOST_FRAMES))
            self.assertLessEqual(max(np.diff(chosen), default=1), 2.5 * n / len(chosen) + 1)

    def test_are_all_shown_where_they_are_few_and_small(self):
        self.assertEqual(sand.chosen_outputs(51, 17, 3584), list(range(51)))

    def test_are_fewer_of_many_particles(self):
        self.assertLessEqual(len(sand.chosen_outputs(100, 50, 10**6)), 20)


class TheScale(unittest.TestCase):
    def test_of_pressure_and_strain_has_zero_and_that_of_density_has_not(self):
        p, density, strain = sand.QUANTITIES

        self.assertEqual(shades.scale_of(p, np.linspace(4e3, 97e3, 999))[:2], (0, 100e3))
        self.assertGreater(shades.scale_of(density, np.linspace(1600, 1700, 999)).low, 1500)
        self.assertEqual(shades.scale_of(strain, np.linspace(0.02, 0.097, 999)).low, 0)

    def test_is_one_between_two_numbers_whatever_there_is(self):
        for quantity in sand.QUANTITIES:
            for values in [[], [0.0], [1600.0], [-3.0, -3.0], [1600, 1600.001]]:
                scale = shades.scale_of(quantity, np.array(values))
                self.assertLess(scale.low, scale.high, (quantity.field, values))
                self.assertEqual(len(scale.palette()), shades.N_LEVELS + 3)

    def test_of_strain_is_grey_at_zero_and_of_two_colours_at_its_ends(self):
        scale = shades.Scale(-0.1, 0.1, "", True)
        low, middle, high = (scale.colours()[k][:3] for k in (0, shades.N_LEVELS // 2, -1))

        self.assertGreater(low[0], low[2])
        self.assertLess(np.ptp(middle), 0.1)
        self.assertGreater(high[2], high[0])

    def test_does_not_go_by_the_few_particles_that_are_beyond_it(self):
        scale = shades.scale_of(sand.QUANTITIES[0], np.array([*np.linspace(0, 1e5, 9999), 1e9]))

        self.assertEqual(scale.high, 1e5)
        self.assertEqual(scale.levels(np.array([-5.0, 1e9])).tolist(), [0, shades.N_LEVELS - 1])


@unittest.skipUnless(h5py, "h5py is not here")
class ThePictures(InAFolder):
    def test_show_the_sand_at_the_output_nearest_to_the_greatest_force(self):
        write_fields(self.folder / "fields.h5")
        found = read(self.folder)
        html = sand_charts.section(found)

        self.assertAlmostEqual(found.still.time, 2e-3)
        self.assertEqual(found.peak, 2)
        p = found.still.value["p"]
        rows, columns = found.still.kind.shape
        self.assertAlmostEqual(float(p[rows // 4, columns * 3 // 4]), 2e3 * 1.75, delta=40)
        self.assertTrue(np.isnan(p[-2, 2]))
        self.assertEqual(found.still.kind[-2, 2], 0)
        self.assertIn("At 2 ms, the output of fields nearest to the greatest contact force on punch, 5 kN/m at 1.9 ms "
                      "(a mean over the history interval).", html)
        for title in ["Pressure p at 2 ms; compression positive", "Density at 2 ms", "steel, rigid", "kg/m³",
                      "Plastic volumetric strain at 2 ms; compaction"]:
            self.assertIn(title, html)
        self.assertEqual(len(re.findall('<img alt="" src="data:image/png;base64,', html)), 6)

    def test_have_a_colour_for_each_part_of_the_bar_and_none_where_nothing_is(self):
        write_fields(self.folder / "fields.h5")
        found = read(self.folder)
        scale = shades.scale_of(sand.QUANTITIES[0], sand.of_sand(found.still, "p"))
        shown = shades.indices(found.still, "p", scale, found.wanted.rigid_numbers())

        image = Image.open(io.BytesIO(shades.png(shown, scale))).convert("RGBA")

        lower_left, lower_right, upper_left = (image.getpixel(at) for at in
                                               [(1, image.height - 2), (image.width - 2, image.height - 2), (1, 1)])
        self.assertEqual(upper_left, (0x8f, 0x95, 0x9f, 255))
        self.assertGreater(sum(lower_right[:2]), sum(lower_left[:2]) + 100)

    def test_in_space_are_of_particles_within_half_a_cell_of_the_plane(self):
        with h5py.File(self.folder / "fields.h5", "w") as file:
            for z, value in [(0.0, 1.0), (0.024, 5.0), (0.026, 9.0), (-0.3, 9.0)]:
                position = lattice(40) + [0, 0, z]
                name = f"step_{0:08d}/particles/sand"
                old = file[name]["position"][()] if name in file else np.zeros((0, 3))
                p = np.concatenate([file[name]["p"][()] if name in file else [], np.full(len(position), value)])
                file.pop(name, None)
                write_material(file, "step_00000000", 0, "sand", np.concatenate([old, position]), p=p)
        found = read(self.folder, slab={"axis": "z", "at": 0.01}, dimension=3)

        self.assertEqual(set(np.unique(sand.of_sand(found.still, "p"))), {1.0})
        self.assertIn("within half a cell of z = 10 mm", sand_charts.lead(found))

    def test_of_a_quantity_that_the_scene_left_out_are_replaced_by_the_key_that_adds_it(self):
        write_fields(self.folder / "fields.h5", fields=("p",))
        html = sand_charts.section(read(self.folder))

        self.assertIn("Pressure p at", html)
        self.assertEqual(re.findall(r'<code>"(\w+)"</code> in the scene\'s <code>output/fields</code> adds it', html),
                         ["density", "plastic_volumetric"])

    def test_of_plastic_strain_are_not_missed_where_no_material_has_it(self):
        write_fields(self.folder / "fields.h5", fields=("p", "density"))
        html = sand_charts.section(read(self.folder, history=HISTORY.replace(".plastic_volumetric_max", ".q_max")))

        self.assertNotIn("plastic", html)
        self.assertNotIn("adds it", html)

    def test_are_a_line_where_the_scene_chose_none_of_the_quantities(self):
        write_fields(self.folder / "fields.h5", fields=())
        found = read(self.folder)

        self.assertIn('"density"', sand_charts.section(found))
        self.assertEqual(movie.section(found), "")

    def test_of_a_body_that_is_heavier_leave_the_scale_to_the_sand(self):
        with h5py.File(self.folder / "fields.h5", "w") as file:
            write_material(file, "step_00000000", 0, "sand", lattice(40), density=np.linspace(1500, 1700, 800))
            write_material(file, "step_00000000", 0, "steel", lattice(40)[:90] + [0, 0.25, 0], density=8000)
        run = run_in(self.folder)
        run["scene"]["bodies"]["punch"]["rigid"] = False
        html = sand_charts.section(sand.read(sand.wanted(run)))

        self.assertIn("Values beyond the colour bar (up to 8\u202f000 kg/m³) take its end colour; they are often those "
                      "of single particles, such as ones thrown up, or of another material.", html)
        self.assertIn("1\u202f700 kg/m³", html)


@unittest.skipUnless(h5py, "h5py is not here")
class DamagedFields(InAFolder):
    def reason(self):
        html = sand_charts.section(read(self.folder))
        self.assertIn("There are no pictures of the sand: ", html)
        self.assertNotRegex(html, "Error|NoneType|<svg|HDF5 library|errno")
        return html

    def test_are_a_line_of_the_page_and_no_failure(self):
        self.assertIn("fields.h5: no such file", self.reason())
        path = self.folder / "fields.h5"
        path.write_bytes(b"no fields")
        self.assertIn("damaged: no HDF5 file that is whole", self.reason())
        write_fields(path)
        path.write_bytes(path.read_bytes()[:5000])
        self.reason()

    def test_are_told_from_sound_ones_by_what_they_lack(self):
        path = self.folder / "fields.h5"
        for spoil, words in [(lambda file: file["step_00000002"].attrs.pop("time"), "damaged"),
                             (lambda file: file.pop("step_00000002/particles"), "damaged: no"),
                             (lambda file: file.pop("step_00000003/particles/sand/position"), "damaged: no"),
                             (lambda file: replace(file, "p", np.ones(3)), "fewer values than particles"),
                             (lambda file: replace(file, "position", np.ones((4, 2))), "no vectors"),
                             (lambda file: replace(file, "p", np.array([b"text"] * 700)), "damaged"),
                             (lambda file: [file.pop(name) for name in list(file)], "holds no outputs")]:
            write_fields(path)
            with h5py.File(path, "r+") as file:
                spoil(file)
            self.assertIn(words, self.reason())

    def test_that_say_they_are_longer_than_the_file_are_not_read(self):
        path = self.folder / "fields.h5"
        write_fields(path)
        with h5py.File(path, "r+") as file:
            for name, shape in [("position", (10**12, 3)), ("p", (10**12,))]:
                del file[f"step_00000002/particles/sand/{name}"]
                file.create_dataset(f"step_00000002/particles/sand/{name}", shape)

        self.assertIn("fewer values than particles", self.reason())


def replace(file, name, values):
    del file[f"step_00000002/particles/sand/{name}"]
    file[f"step_00000002/particles/sand/{name}"] = values


@unittest.skipUnless(h5py, "h5py is not here")
class TheMovie(InAFolder):
    def made(self, **how):
        write_fields(self.folder / "fields.h5", **how)
        html = movie.section(read(self.folder))
        data = json.loads(re.search('id="movie-data">(.*?)</script>', html, re.DOTALL)[1])
        return html, data

    def test_has_a_picture_of_each_output_and_quantity_with_its_time_and_force(self):
        html, data = self.made()

        self.assertEqual({field: len(made) for field, made in data["pictures"].items()}, dict.fromkeys(FIELDS, 5))
        self.assertEqual(data["times"][0], "0 s; contact force on punch 0 N/m")
        self.assertEqual(len(data["times"]), 5)
        for made in data["pictures"].values():
            image = Image.open(io.BytesIO(base64.b64decode(made[3])))
            self.assertEqual((image.format, image.width), ("PNG", sand.MOVING))
        self.assertNotIn("Thinned", html)

    def test_can_be_moved_by_keys_and_says_its_names(self):
        tags = Tags(self.made()[0])

        self.assertEqual((tags.wrong, tags.open), ([], []))
        slider, = [tag for tag in tags.of("input") if tag["type"] == "range"]
        self.assertEqual((slider["min"], slider["max"], slider["value"]), ("0", "4", "2"))
        self.assertIn("aria-label", slider)
        self.assertEqual([tag["value"] for tag in tags.of("input") if tag["type"] == "radio"], list(FIELDS))
        self.assertEqual(len(tags.of("button")), 1)

    def test_says_how_many_outputs_were_left_out(self):
        html, data = self.made(n=6, n_outputs=90)

        self.assertEqual(len(data["times"]), sand.MOST_FRAMES)
        self.assertIn("Thinned: 60 of 90 outputs of fields are here.", html)

    def test_is_not_there_for_a_single_output(self):
        write_fields(self.folder / "fields.h5", n_outputs=1)

        self.assertEqual(movie.section(read(self.folder)), "")
        self.assertEqual(movie.section(None), "")

    def test_holds_no_text_that_ends_its_script(self):
        text = movie.as_json({"times": ["</script><b>&"]})

        self.assertNotIn("<", text)
        self.assertEqual(json.loads(text), {"times": ["</script><b>&"]})

    def test_and_pictures_of_noise_leave_a_page_below_five_megabytes(self):
        random = np.random.default_rng(7)
        kind = np.zeros((sand.MOVING, sand.MOVING), np.int8)
        still = np.zeros((sand.STILL, sand.STILL), np.int8)

        def noise(time, kind):
            return sand.Frame(time, kind, {field: random.normal(1000, 300, kind.shape).astype(np.float32)
                                           for field in FIELDS})

        frames = [noise(1e-3 * k, kind) for k in range(60)]
        asked = sand.Wanted("", sand.Plane(AXES, None, np.inf), ["sand"], [], {}, None, True)
        found = sand.Sand("", asked, sand.QUANTITIES, [], noise(0.03, still), frames, 30, 60)
        pictures = sand_charts.section(found)
        moving = movie.section(found, run_page.MOST_BYTES - 1_000_000 - len(pictures))

        self.assertLess(len(pictures), 1_100_000)
        self.assertLess(len(pictures) + len(moving), 4_000_000)
        self.assertIn("so that the page stays small", moving)

    def test_is_left_smaller_where_the_page_has_less_room(self):
        shown = {"p": [np.random.default_rng(1).integers(0, 30, (200, 300)).astype(np.uint8) for _ in range(4)]}
        scales = {"p": shades.Scale(0, 1, "Pa", False)}

        for room in [400_000, 100_000, 20_000]:
            made, share = laid_over.fitted(shown, scales, room)
            self.assertLessEqual(sum(map(len, made["p"])), room)
            self.assertGreater(sum(map(len, made["p"])), 0.5 * min(room, 300_000))
            self.assertTrue(0 < share <= 1)


@unittest.skipUnless(h5py, "h5py is not here")
class FiftyThousandParticles(InAFolder):
    def test_of_sixty_outputs_are_all_on_a_page_below_five_megabytes(self):
        with h5py.File(self.folder / "fields.h5", "w") as file:
            position = lattice(316)
            for k in range(60):
                r = np.hypot(position[:, 0] - 0.5, position[:, 1] - 0.5)
                wave = np.exp(-(((r - 0.01 * k) / 0.05) ** 2))
                write_material(file, f"step_{k:08d}", 1e-3 * k, "sand", position, p=1e6 * wave,
                               density=1600 + 100 * wave, plastic_volumetric=0.02 * wave)
        run = run_in(self.folder)
        run["scene"]["grid"]["cell_size"] = 2 / 316
        found = sand.read(sand.wanted(run))
        html = sand_charts.section(found) + movie.section(found)

        self.assertEqual((len(position), len(found.frames)), (316 * 158, 60))
        self.assertLess(len(html), 4_000_000)
        self.assertNotIn("outputs of fields are here", html)


class WithoutFields(unittest.TestCase):
    def test_a_page_has_no_section_of_the_sand(self):
        run = run_in("nowhere")
        for change in [{"page": None}, {"scene": None}, {"page": {"materials": [], "pictures": []}}]:
            self.assertIsNone(sand.wanted({**run, **change}))
        self.assertIsNone(sand.read(None))
        self.assertEqual(sand_charts.section(None), "")

    def test_that_are_sound_the_reason_stands_in_the_place_of_the_particles(self):
        self.assertIn("fields.h5: cannot &lt;read&gt;.", run_page.pictures([], "fields.h5: cannot <read>"))
        self.assertIn("The run wrote no fields", run_page.pictures([]))


if __name__ == "__main__":
    unittest.main()
