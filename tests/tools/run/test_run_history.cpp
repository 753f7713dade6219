#include "tools/run/run_history.hpp"

#include <catch2/catch.hpp>

#include "tasks/labels.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_run_history
{

using namespace tamp;

namespace
{

/// A rigid block that nothing holds, on a grid open all round.
const char* falling_block = R"({
  "dimension": 2,
  "grid": { "upper": [2, 2], "cell_size": 0.25 },
  "boundaries": { "x-": "open", "x+": "open", "y-": "open", "y+": "open" },
  "time": { "end": 0.2, "maximum_step": 0.01 },
  "gravity": [0, -10],
  "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e5, "shear_modulus": 1e5 } },
  "bodies": {
    "block": {
      "material": "steel", "rigid": true, "geometry": { "type": "box", "lower": [0.5, 1], "upper": [1, 1.5] }
    }
  }
})";

double depth_at_end(const std::string& velocity)
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked = tools::read_scene(file, {"/bodies/block/velocity=" + velocity});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  while (simulation->time() < 0.2) simulation->advance(0.2);
  history.measure();
  return history.depth(history.tracked_bodies().at(0));
}

void push_along_x(const runtime::GridView<components::NodeMotion<2>>& motion, double push)
{
  for_each(motion.box(), [&](const runtime::Index& i) {
    const Vector<2> more(push, 0);
    motion[i].set(motion[i].velocity() + more, motion[i].velocity_change() + more);
  });
}

}  // namespace

TEST_CASE("the depth of a body is taken along its initial velocity")
{
  CHECK(depth_at_end("[1,0]") == Approx(0.2));
  CHECK(depth_at_end("[0,-1]") == Approx(0.4));
}

TEST_CASE("the depth of a body that starts at rest is the way it has moved")
{
  CHECK(depth_at_end("[0,0]") == Approx(0.2));
}

TEST_CASE("the history of a pressed body has the force of its load, and counts its work")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked = tools::read_scene(
      file, {"/bodies/block/rigid=false", "/gravity=[0,0]", "/output/history_interval=0.02",
             R"(/bodies/block/pressure={"values":[[0,0],[0.2,100]],"within":{"lower":[0,1.4],"upper":[2,2]}})"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  history.begin(folder.path());
  simulation->advance(0.01);
  while (simulation->time() < 0.2) simulation->advance(0.2);

  history.write_row();

  const std::string text = test::read_text(folder.path() / "history.csv");
  CHECK_THAT(text, Catch::Contains("block.depth[m]") && Catch::Contains("block.load_x[N],block.load_y[N]"));
  // The mean of a ramp on a side of 0.5 m; to that of the steps.
  const Eigen::Vector3d momentum = simulation->report().momentum();
  CHECK(momentum.y() == Approx(-0.5 * 0.5 * 100 * 0.2).epsilon(0.1));
  CHECK(history.momentum_error() < 1e-9);
  CHECK(history.energy_error() < 0.02);
  CHECK(history.energies().external > 0);
}

TEST_CASE("the error of momentum is one of the motion, also where momenta cancel")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked =
      tools::read_scene(file, {"/gravity=[0,0]", "/bodies/block/rigid=false", "/bodies/block/angular_velocity=[5]"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  for (int n = 0; n < 50; ++n) simulation->advance(1);

  history.measure();

  CHECK(history.report().momentum().norm() < 1e-9);
  CHECK(history.momentum_error() < 1e-13);
}

TEST_CASE("the error of momentum is one of the largest motion so far, also when a body stands still again")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked = tools::read_scene(file, {"/bodies/block/velocity=[0,1]", "/time/maximum_step=1e-3"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  const double at_start = history.report().sum_of_momenta;
  while (simulation->time() < 0.1005) simulation->advance(0.1005);

  history.measure();

  CHECK(at_start == Approx(2000));
  CHECK(history.report().sum_of_momenta < 0.02 * at_start);
  CHECK(history.largest().momenta >= at_start);
  CHECK(history.momentum_error() < 1e-13);
}

TEST_CASE("momentum from nowhere is told by as much as the body is faster, and warned of beyond the limit")
{
  const double push = GENERATE(1e-4, 3e-4);  // m/s in each of 50 steps
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked = tools::read_scene(
      file, {"/gravity=[0,0]", "/bodies/block/rigid=false", "/bodies/block/velocity=[1,0]", "/time/maximum_step=1e-4"});
  // The program has no task that does this: one is put behind the last that changes the motion of nodes.
  const auto simulation =
      tasks::Simulation::make(checked.scene, std::make_shared<runtime::Executor>(1), {}, [&](runtime::TaskList& step) {
        const auto walls = std::ranges::find(step, "walls", &runtime::TaskDeclaration::name);
        step.insert(std::next(walls), runtime::task("push")
                                          .over_patches()
                                          .updates(tasks::node::motion<2>.halo(1).every_group())
                                          .body([&](const runtime::TaskContext&, auto data) {
                                            push_along_x(data[tasks::node::motion<2>][0], push);
                                          }));
      });
  tools::RunHistory history(*simulation);
  history.begin(folder.path());
  for (int n = 0; n < 50; ++n) simulation->advance(1);

  history.write_row();

  const double faster = 50 * push;
  CHECK(history.report().momentum().x() == Approx(2000 * (1 + faster)));
  CHECK(history.momentum_error() == Approx(faster / (1 + faster)));
  CHECK(history.balances_above().momentum_error.count == (faster > 0.01 ? 1 : 0));
}

TEST_CASE("sand at rest has no error of momentum but round-off of its weight")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", R"({
    "dimension": 2, "grid": { "upper": [1, 2], "cell_size": 0.25 }, "boundaries": { "y+": "open" },
    "time": { "end": 1 }, "gravity": [0, -10],
    "materials": { "sand": { "file": ")" TAMP_SOURCE_DIR R"(/inputs/materials/concrete-sand/table.json" } },
    "bodies": { "bed": { "material": "sand", "initial_stress": true,
                         "geometry": { "type": "box", "lower": [0, 0], "upper": [1, 1] } } }
  })");
  const auto checked = tools::read_scene(file, {});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  for (int n = 0; n < 100; ++n) simulation->advance(1);

  history.measure();

  CHECK(history.report().sum_of_momenta < 1e-9 * history.largest().momenta);
  CHECK(history.momentum_error() < 1e-12);
}

TEST_CASE("the half step that velocities lag behind has the work of gravity")
{
  const bool rigid = GENERATE(true, false);
  const test::TemporaryFolder folder;
  const double g = 10, speed = 1, dt = 1e-3;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked = tools::read_scene(
      file, {"/bodies/block/velocity=[0,1]", std::string("/bodies/block/rigid=") + (rigid ? "true" : "false"),
             "/time/maximum_step=1e-3"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  for (int n = 0; n < 50; ++n) simulation->advance(1);
  REQUIRE(simulation->last_step_size() == dt);

  history.measure();

  // Second order in the step: the velocity changes by g dt / 2 within that half. Without its work it were g dt / v.
  CHECK(history.energy_error() == Approx(g * g * dt * dt / (4 * speed * speed)).epsilon(1e-6));
}

TEST_CASE("the energy of a body that FMPM moves is all there once what it filters is counted")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked =
      tools::read_scene(file, {"/gravity=[0,0]", "/bodies/block/rigid=false", "/bodies/block/angular_velocity=[5]",
                               "/transfer=fmpm", "/filter_order=4", "/grid/cell_size=0.0625"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  for (int n = 0; n < 100; ++n) simulation->advance(1);

  history.measure();

  CHECK(history.energies().elastic > 1e-3 * history.energies().kinetic);
  CHECK(history.energy_error() < 1e-12);
}

TEST_CASE("energy is balanced and judged also after particles have left")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked = tools::read_scene(
      file, {"/bodies/block/rigid=false", "/bodies/block/velocity=[20,0]", "/bodies/block/angular_velocity=[20]",
             "/time/end=1", "/grid/cell_size=0.125", "/time/maximum_step=1e-3"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  const double at_start = history.report().kinetic;
  const auto n_at_start = simulation->n_particles(0);
  while (simulation->lost().count < n_at_start / 2) simulation->advance(1);

  history.measure();

  const tools::EnergyBalance& e = history.energies();
  CHECK(e.kinetic < 0.7 * at_start);
  CHECK(e.external > 0);
  CHECK(history.energy_error() < 1e-3);
  CHECK(std::abs(e.total - at_start) < 1e-3 * at_start);
}

TEST_CASE("the loss of particles does not end the judgement of energy")
{
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked =
      tools::read_scene(file, {"/gravity=[0,0]", "/bodies/block/rigid=false", "/bodies/block/velocity=[20,0]",
                               "/bodies/block/angular_velocity=[20]", "/time/end=1", "/grid/cell_size=0.125"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  while (simulation->lost().count == 0) simulation->advance(1);

  const double error = history.energy_error();

  CHECK_THAT(history.energy_problem(0.5 * error), Catch::Contains("the energy is wrong by"));
  CHECK(history.energy_problem(2 * error).empty());
}

TEST_CASE("what is judged of each step is the balance that the history shows")
{
  const std::string given = GENERATE("/bodies/block/rigid=true", "/bodies/block/rigid=false");
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.json", falling_block);
  const auto checked =
      tools::read_scene(file, {given, "/bodies/block/angular_velocity=[5]", "/time/maximum_step=1e-3"});
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  const double at_start = history.report().kinetic;
  for (int n = 0; n < 100; ++n) simulation->advance(1);

  history.measure();

  CHECK(history.energies().total - at_start == Approx(simulation->energies().sum()).margin(1e-10 * at_start));
}

TEST_CASE("an energy error is reported beyond its limit, and never where the limit is off")
{
  const auto checked = tools::read_scene(TAMP_SOURCE_DIR "/inputs/punch/quick.json");
  const auto simulation = tasks::Simulation::make(checked.scene, 1);
  tools::RunHistory history(*simulation);
  for (int n = 0; n < 20; ++n) simulation->advance(1);
  history.measure();
  const double error = history.energy_error();

  REQUIRE(error > 1e-7);
  CHECK_THAT(history.energy_problem(0.5 * error), Catch::Contains("the energy is wrong by"));
  CHECK(history.energy_problem(2 * error).empty());
  CHECK(history.energy_problem(std::numeric_limits<double>::infinity()).empty());
}

}  // namespace test_run_history
