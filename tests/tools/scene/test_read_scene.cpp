#include <algorithm>
#include <catch2/catch.hpp>

#include "runtime/file_error.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/json/print_json.hpp"

namespace test_read_scene
{

using namespace tamp;
using namespace tamp::test;
using tools::read_scene;

TEST_CASE("a scene is read into what a run is made from")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const tasks::Scene scene = read_scene(file).scene;

  CHECK(scene.name == "small");
  CHECK(scene.grid.dimension == 2);
  CHECK(scene.grid.n_cells == runtime::Index{2, 2, 1});
  CHECK(scene.n_patches == runtime::Index{1, 1, 1});
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials[0].density == 8000);
  CHECK(std::get<components::Hypoelastic>(scene.materials[0].model).shear_modulus == 7e9);
  REQUIRE(scene.bodies.size() == 1);
  CHECK(scene.bodies[0].material == 0);
  CHECK(scene.bodies[0].n_particles == 4);
}

TEST_CASE("comments of a scene change nothing of it, and values of --set have none")
{
  const TemporaryFolder folder;
  std::string commented = small_scene;
  commented.replace(commented.find("\"grid\""), 0, "// two cells, http://localhost\n  /* \"grid\": 1, */ ");
  commented += " // the end";

  const auto plain = read_scene(folder.write("plain/small.json", small_scene));
  const auto with_comments = read_scene(folder.write("commented/small.json", commented));
  const auto titled = read_scene(folder.write("small.json", small_scene), {"/title=\"a\" // b"});

  CHECK(with_comments.resolved["grid"] == plain.resolved["grid"]);
  CHECK(with_comments.resolved["bodies"] == plain.resolved["bodies"]);
  CHECK(titled.scene.title == "\"a\" // b");
}

TEST_CASE("a transfer is read with its own number, and resolves without those of others")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const auto blend = read_scene(file, {"/transfer=blend", "/flip_part=0.9"});
  const auto xpic = read_scene(file, {"/transfer=xpic", "/filter_order=5"});
  const auto fmpm = read_scene(file, {"/transfer=fmpm"});

  CHECK(blend.scene.transfer == tasks::Transfer("blend"));
  CHECK(blend.scene.transfer_numbers.flip_part == 0.9);
  CHECK(xpic.scene.transfer_numbers.filter_order == 5);
  CHECK(fmpm.scene.transfer_numbers.filter_order == 2);
  CHECK(fmpm.resolved["filter_order"] == 2);
  CHECK_FALSE(fmpm.resolved.contains("flip_part"));
}

TEST_CASE("what a scene leaves out has the documented default")
{
  const TemporaryFolder folder;

  const tasks::Scene scene = read_scene(folder.write("small.json", small_scene)).scene;

  CHECK(scene.title == "small");
  CHECK(scene.grid.lower == tasks::Triple{0, 0, 0});
  CHECK(components::traits_of(scene.faces[1][1]).is_mirror);
  CHECK(scene.time.rule == tasks::StepRule::viscous);
  CHECK(scene.time.multiplier == 0.8);
  CHECK(scene.time.minimum_step == 1e-12);
  CHECK(std::isinf(scene.time.maximum_step));
  CHECK(scene.particles_per_axis == 2);
  CHECK(scene.gravity == tasks::Triple{0, 0, 0});
  CHECK_FALSE(scene.artificial_viscosity.has_value());
  CHECK(scene.contacts.empty());
  CHECK(scene.output.fields_interval == 1.0 / 50);
  CHECK(scene.output.history_interval == 1.0 / 1000);
}

TEST_CASE("a scene that is read says which keys it leaves out, and no other")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const auto left_out = read_scene(file, {"/transfer=pic", "/local_damping=null"}).left_out;

  const auto names = [&](const std::string& key) { return std::ranges::count(left_out, key) == 1; };
  CHECK(names("/interpolator"));
  CHECK(names("/boundaries/x-"));
  CHECK(names("/bodies/block/rigid"));
  CHECK(names("/local_damping"));
  CHECK_FALSE(names("/transfer"));
  CHECK_FALSE(names("/grid/cell_size"));
}

TEST_CASE("the scene as resolved reads back as the same scene, from any folder")
{
  const TemporaryFolder folder, elsewhere;
  write_sand(folder);
  const auto file = folder.write("small.json", small_scene);
  const auto first = read_scene(file, {"/materials/sand/file=" + (folder.path() / "sand.json").string(),
                                       "/contact=[{\"materials\":[\"steel\",\"sand\"],\"friction\":0.1}]",
                                       "/artificial_viscosity={}", "/boundaries/x+=open"});

  const auto again = read_scene(elsewhere.write("small.json", tools::printed(first.resolved)));

  auto with_its_own_files = again.resolved;
  with_its_own_files["inputs"] = first.resolved["inputs"];
  CHECK(with_its_own_files == first.resolved);
  CHECK(again.scene.contacts.at(0).friction == 0.1);
  CHECK_FALSE(components::traits_of(again.scene.faces[0][1]).is_wall());
  CHECK(again.scene.artificial_viscosity->quadratic == 2.0);
  CHECK(std::get<components::TabularCap>(again.scene.materials.at(1).model).crush_pressure(0.1) == 2e7);
}

TEST_CASE("Bolton's sand has the density of its relative density, and at rest the stress across that Jaky found")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);
  const std::string sand =
      R"(/materials/steel={"type":"bolton_sand","relative_density":0.75,"grain_density":2640,"e_min":0.6,"e_max":0.8,)"
      R"("critical_friction_angle":30,"shear_modulus_number":125,"poisson_ratio":0.2})";

  const auto checked = read_scene(file, {sand, "/gravity=[0,-10]", "/bodies/block/geometry/upper=[2,1]",
                                         "/boundaries/y+=open", "/bodies/block/initial_stress=true"});
  const auto again = read_scene(folder.write("again.json", tools::printed(checked.resolved)));

  // e = 0.8 - 0.75 (0.8 - 0.6) = 0.65
  CHECK(checked.scene.materials[0].density == Approx(1600));
  CHECK(checked.resolved["materials"]["steel"]["density"] == checked.scene.materials[0].density);
  CHECK(again.scene.materials[0].density == checked.scene.materials[0].density);
  REQUIRE(checked.scene.bodies[0].k0);
  CHECK(*checked.scene.bodies[0].k0 == Approx(0.5));
}

TEST_CASE("strata that start settled meet by the normal of the flatter surface, unless the scene has another")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);
  const auto normal = [&](const std::string& set) {
    const std::string soil =
        R"(/materials/soil={"type":"hypoelastic","density":2000,"bulk_modulus":1e9,"shear_modulus":7e8})";
    const std::string top =
        R"(/bodies/top={"material":"soil","initial_stress":true,"geometry":{"type":"box","lower":[0,1],"upper":[2,2]}})";
    return read_scene(file, {soil, "/bodies/block/initial_stress=true", "/bodies/block/geometry/upper=[2,1]", top,
                             "/boundaries/y+=open", "/gravity=[0,-10]", set})
        .scene.contacts.at(0)
        .normal;
  };
  const auto listed = [](const std::string& more) {
    return "/contact=[{\"materials\":[\"steel\",\"soil\"],\"friction\":0.5" + more + "}]";
  };

  CHECK(std::holds_alternative<components::FlatterNormal>(normal("/title=unlisted")));
  CHECK(std::holds_alternative<components::FlatterNormal>(normal(listed(""))));
  CHECK(std::holds_alternative<components::RegressionNormal>(normal(listed(",\"normal\":\"regression\""))));
  CHECK(std::holds_alternative<components::RegressionNormal>(normal("/bodies/top/initial_stress=false")));
}

TEST_CASE("every scene that comes with the program is sound")
{
  const std::filesystem::path inputs = std::filesystem::path(TAMP_SOURCE_DIR) / "inputs";
  int n_scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(inputs / "punch")) {
    INFO(entry.path().string());
    CHECK_NOTHROW(read_scene(entry.path()));
    ++n_scenes;
  }
  CHECK(n_scenes >= 4);
}

TEST_CASE("the published punch has the published numbers")
{
  const tasks::Scene scene = read_scene(std::filesystem::path(TAMP_SOURCE_DIR) / "inputs/punch/table.json").scene;

  CHECK(scene.grid.n_cells == runtime::Index{100, 80, 1});
  CHECK(scene.n_patches == runtime::Index{4, 1, 1});
  CHECK(scene.time.end == 7e-3);
  CHECK(scene.time.rule == tasks::StepRule::published);
  CHECK(scene.time.multiplier == 0.05);
  CHECK(scene.materials.at(0).density == 8000);
  CHECK(scene.materials.at(1).density == 1050);
  CHECK(scene.bodies.at(0).n_particles == 60 * 40);
  CHECK(scene.bodies.at(1).n_particles == 200 * 100);
  CHECK(scene.bodies.at(0).velocity == tasks::Triple{0, -200, 0});
  CHECK(scene.contacts.at(0).friction == 0.1);
}

TEST_CASE("materials and bodies are numbered in the order in which they stand")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const tasks::Scene scene =
      read_scene(file, {R"(/materials/aluminium={"type":"hypoelastic","density":2700,"bulk_modulus":7e10,)"
                        R"("shear_modulus":2.6e10})"})
          .scene;

  CHECK(scene.materials.at(0).name == "steel");
  CHECK(scene.materials.at(1).name == "aluminium");
}

TEST_CASE("all problems of a scene are reported at once")
{
  const std::string problems =
      problems_with({"/grid/cell_size=-1", "/time/end=\"soon\"", "/materials/steel/density=-8000", "/gravty=[0,0]"});

  CHECK(std::count(problems.begin(), problems.end(), '\n') == 3);
}

TEST_CASE("a scene file that does not exist is an error of the input")
{
  CHECK_THROWS_AS(read_scene("/no/such/scene.json"), tools::InputError);
  CHECK_THROWS_WITH(read_scene("/no/such/scene.json"), "/no/such/scene.json: no such file; expected the name of one");
}

TEST_CASE("a grid that is wrong does not make every body seem to lie outside of it")
{
  CHECK(problems_with({"/grid/upper=[-2,-2]"}).find("geometry") == std::string::npos);
}

TEST_CASE("a body of three dimensions is counted in three dimensions")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const tasks::Scene scene =
      read_scene(file, {"/dimension=3", "/grid/upper=[2,2,2]", "/bodies/block/geometry/lower=[0,0,0]",
                        "/bodies/block/geometry/upper=[1,1,2]"})
          .scene;

  CHECK(scene.bodies.at(0).n_particles == 16);
}

TEST_CASE("a disk whose particles lie on rings has its area, and is as round as it is asked to be")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const auto checked = read_scene(file, {"/bodies/block/particles=rings", "/particles_per_cell=[8,8]",
                                         R"(/bodies/block/geometry={"type":"ball","centre":[1,1],"radius":0.7})"});

  double area = 0, outermost = 0;
  for (const auto& site : tasks::particle_sites<2>(checked.scene, checked.scene.bodies.at(0))) {
    area += site.volume;
    outermost = std::max(outermost, (site.place - Eigen::Vector2d(1, 1)).norm());
  }
  CHECK(area == Approx(0.49 * 3.14159265358979323846));
  // Six rings of 0.117, the nearest to the spacing of 0.125.
  CHECK(outermost == Approx(0.7 * 11 / 12));
  CHECK(checked.resolved["bodies"]["block"]["particles"] == "rings");
}

TEST_CASE("a body whose particles are cut weighs what its solid does, in the plane, about the axis and in space")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);
  const auto volume = [&](std::vector<std::string> assignments, const std::string& ball) {
    assignments.insert(assignments.end(), {"/bodies/block/particles=cut", "/bodies/block/geometry=" + ball});
    const auto scene = read_scene(file, assignments).scene;
    return tasks::particle_volume(scene, scene.bodies.at(0));
  };
  const std::string disk = R"({"type":"ball","centre":[1,1],"radius":0.7})",
                    about_axis = R"({"type":"ball","centre":[0,1],"radius":0.7})",
                    ball = R"({"type":"ball","centre":[1,1,1],"radius":0.7})";
  const double pi = 3.14159265358979323846;

  CHECK(volume({}, disk) == Approx(pi * 0.49).epsilon(1e-12));
  // Points are counted, as the ball goes beyond the axis.
  CHECK(volume({"/axisymmetric=true", "/particles_per_cell=[8,8]"}, about_axis) ==
        Approx(4 * pi / 3 * 0.343).epsilon(1e-3));
  CHECK(volume({"/dimension=3", "/grid/upper=[2,2,2]"}, ball) == Approx(4 * pi / 3 * 0.343).epsilon(1e-12));
}

TEST_CASE("every kind of geometry is read")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);
  const auto volume = [&](const std::string& geometry) {
    const auto scene = read_scene(file, {"/dimension=3", "/grid/upper=[2,2,2]", "/bodies/block/geometry=" + geometry});
    return std::get<components::Solid<3>>(scene.scene.bodies.at(0).solid).volume().value;
  };
  const double pi = 3.14159265358979323846;

  CHECK(volume(R"({"type":"box","lower":[0,0,0],"upper":[1,2,1]})") == Approx(2));
  CHECK(volume(R"({"type":"ball","centre":[1,1,1],"radius":1})") == Approx(4 * pi / 3));
  CHECK(volume(R"({"type":"rotated_box","centre":[1,1,1],"sides":[1,0.5,1],"angle":45})") == Approx(0.5));
  CHECK(volume(R"({"type":"cylinder","first_end":[1,1,0],"second_end":[1,1,2],"radius":0.5})") == Approx(pi / 2));
}

}  // namespace test_read_scene
