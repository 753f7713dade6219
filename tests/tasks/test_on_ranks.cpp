#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

#include "components/problems/axis_aligned.hpp"
#include "tasks/simulation_error.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_on_ranks
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Two disks that glance off each other and leave through the open faces.
Scene glancing_disks()
{
  Scene scene = empty_scene(2, {24, 18, 1}, 0.1);
  scene.n_patches = {6, 6, 1};
  const int soft = add_elastic(scene, 1000, 1e6, 0.3);
  const int hard = add_elastic(scene, 2000, 4e6, 0.2);
  add_disk(scene, soft, 0.7, 0.8, 0.4, {6, 0.5, 0});
  add_disk(scene, hard, 1.7, 1.0, 0.4, {-6, -0.5, 0});
  scene.gravity = {0, -9.81, 0};
  return scene;
}

struct Ending {
  std::string digest;
  double plastic;
  double contact;
  std::size_t n_lost;
  double lost_momentum;

  bool operator==(const Ending&) const = default;
};

Ending ending(Simulation& simulation)
{
  const LostParticles lost = simulation.lost();
  return {simulation.digest(), simulation.energies().plastic, simulation.energies().contact, lost.count,
          lost.momentum[0]};
}

Ending alone(const Scene& scene, double end)
{
  const auto simulation = Simulation::make(scene, 1);
  advance_to(*simulation, end);
  return ending(*simulation);
}

std::unique_ptr<Simulation> on_all_ranks(const Scene& scene, int n_threads)
{
  return Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                          runtime::Communicator::world());
}

}  // namespace

TEST_CASE("a collision with losses ends with the same bits on any ranks and threads", "[ranks][slow]")
{
  Scene scene = glancing_disks();
  const auto [transfer, interpolator, n_threads] = GENERATE(
      std::tuple{Transfer("flip"), Interpolator("gimp"), 1}, std::tuple{Transfer("flip"), Interpolator("gimp"), 3},
      std::tuple{Transfer("tflip"), Interpolator("quadratic_spline"), 2});
  scene.transfer = transfer;
  scene.interpolator = interpolator;
  const Ending expected = alone(scene, 0.3);
  REQUIRE(expected.n_lost > 0);

  const auto simulation = on_all_ranks(scene, n_threads);
  advance_to(*simulation, 0.3);

  CHECK(ending(*simulation) == expected);
}

TEST_CASE("by transfers and interpolators of all kinds disks meet with the same bits on any ranks and threads",
          "[ranks][slow]")
{
  Scene scene = glancing_disks();
  const auto [transfer, interpolator, n_threads] = GENERATE(
      std::tuple{Transfer("pic"), Interpolator("cubic_spline"), 1},
      std::tuple{Transfer("blend"), Interpolator("cpgimp"), 2}, std::tuple{Transfer("tpic"), Interpolator("gimp"), 3},
      std::tuple{Transfer("apic"), Interpolator("cpdi"), 1}, std::tuple{Transfer("xpic"), Interpolator("gimp"), 2},
      std::tuple{Transfer("fmpm"), Interpolator("quadratic_spline"), 2});
  scene.transfer = transfer;
  scene.transfer_numbers.filter_order = 3;
  scene.interpolator = interpolator;

  const auto simulation = on_all_ranks(scene, n_threads);
  advance_to(*simulation, 0.08);

  CHECK(ending(*simulation) == alone(scene, 0.08));
}

TEST_CASE("a collision around a periodic domain ends with the same bits on any ranks and threads", "[ranks][slow]")
{
  Scene scene = glancing_disks();
  scene.grid.periodic = {true, true, false};
  const auto [n_patches, n_threads] =
      GENERATE(std::pair{runtime::Index{2, 1, 1}, 3}, std::pair{runtime::Index{6, 6, 1}, 3});
  scene.n_patches = n_patches;
  const bool smooth = scene.n_patches[0] == 6;
  scene.transfer = smooth ? GENERATE(Transfer("tflip"), Transfer("apic"), Transfer("fmpm")) : Transfer("flip");
  scene.interpolator = smooth ? Interpolator("quadratic_spline") : Interpolator("gimp");
  // The disks pass all faces.
  for (SceneBody& body : scene.bodies) body.velocity[1] -= 5;
  const Ending expected = alone(scene, 0.3);

  const auto simulation = on_all_ranks(scene, n_threads);
  simulation->engine().balance_every(20);
  advance_to(*simulation, 0.3);

  CHECK(ending(*simulation) == expected);
  CHECK(expected.n_lost == 0);
}

TEST_CASE("soil that lands on a floor ends with the same bits on any ranks and threads", "[ranks]")
{
  Scene scene = empty_scene(2, {24, 12, 1}, 0.1);
  scene.n_patches = {6, 3, 1};
  add_walls(scene, 1);
  scene.materials.push_back(
      {"soil", 1600,
       components::DruckerPrager{
           .bulk_modulus = 2e6, .shear_modulus = 1e6, .friction_angle = 30, .dilation_angle = 5, .cohesion = 100}});
  add_box(scene, 0, {0.8, 0.2, 0}, {1.4, 0.8, 0}, {1, -3, 0});
  const Ending expected = alone(scene, 0.2);
  REQUIRE(expected.plastic > 0);
  const int n_threads = GENERATE(1, 3);

  const auto simulation = on_all_ranks(scene, n_threads);
  advance_to(*simulation, 0.2);

  CHECK(ending(*simulation) == expected);
}

TEST_CASE("a body under pressure ends with the same bits on any ranks and threads", "[ranks]")
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  scene.n_patches = {4, 3, 1};
  scene.faces[0][0] = components::SymmetryFace();
  scene.local_damping = 0.3;
  const auto [interpolator, n_threads] =
      GENERATE(std::pair{Interpolator("gimp"), 3}, std::pair{Interpolator("quadratic_spline"), 1});
  scene.interpolator = interpolator;
  add_disk(scene, add_elastic(scene, 1000, 1e6, 0.3), 0, 0.6, 0.5, {0, 0, 0}).pressure =
      BodyPressure{components::PressureCurve({{0, 1e3}, {0.1, 1e4}}), {{0, 0.4, 0}, {1, 2, 0}}};
  const auto pushed = [](Simulation& simulation) { return Eigen::Vector3d(simulation.take_mean_forces().loads.at(0)); };
  const auto single = Simulation::make(scene, 1);
  advance_to(*single, 0.1);

  const auto simulation = on_all_ranks(scene, n_threads);
  advance_to(*simulation, 0.1);

  CHECK(ending(*simulation) == ending(*single));
  CHECK(simulation->energies().driving == single->energies().driving);
  CHECK(pushed(*simulation) == pushed(*single));
}

TEST_CASE("rings that meet on the axis end with the same bits on any ranks and threads", "[ranks]")
{
  Scene scene = glancing_disks();
  scene.axisymmetric = true;
  scene.faces[0][0] = components::SymmetryFace();
  scene.bodies.clear();
  add_disk(scene, 0, 0, 0.5, 0.35, {0, 6, 0});
  add_disk(scene, 1, 0.1, 1.3, 0.4, {0, -6, 0});
  scene.transfer = GENERATE(Transfer("flip"), Transfer("apic"));
  const Ending expected = alone(scene, 0.2);

  const auto simulation = on_all_ranks(scene, 2);
  advance_to(*simulation, 0.2);

  CHECK(ending(*simulation) == expected);
}

TEST_CASE("a collision in three dimensions ends with the same bits on any ranks", "[ranks]")
{
  Scene scene = empty_scene(3, {12, 8, 8}, 0.1);
  scene.n_patches = {4, 2, 2};
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("cpdi"));
  const int soft = add_elastic(scene, 1000, 1e6, 0.3);
  add_box(scene, soft, {0.1, 0.2, 0.2}, {0.5, 0.6, 0.6}, {5, 0.5, 0});
  add_box(scene, add_elastic(scene, 1500, 1e6, 0.2), {0.6, 0.3, 0.2}, {1.0, 0.7, 0.6}, {-5, 0, 0.5});

  const auto simulation = on_all_ranks(scene, 2);
  advance_to(*simulation, 0.02);

  CHECK(ending(*simulation) == alone(scene, 0.02));
}

TEST_CASE("a block that starts deformed and is driven by body forces ends with the same bits on any ranks and threads",
          "[ranks]")
{
  const auto [dimension, n_threads] = GENERATE(std::pair{2, 3}, std::pair{3, 1});
  Scene scene = empty_scene(dimension, {12, 12, dimension == 3 ? 12 : 1}, 1.0 / 12);
  scene.n_patches = {4, 2, dimension == 3 ? 2 : 1};
  for (std::size_t k = 0; k < 3; ++k) add_walls(scene, k);
  scene.materials.push_back({"soft", 1, components::NeoHookean{8333, 3846}});
  const components::AxisAligned problem{.amplitude = 0.05, .length = 1, .n_axes = dimension};
  add_box(scene, 0, {0, 0, 0}, {1, 1, 1}).functions = problem.functions({dimension, 1, scene.materials[0].model});
  const auto outcome = [](Simulation& simulation) {
    const DisplacementError error = simulation.report().displacement_errors[0];
    return std::tuple(simulation.digest(), simulation.energies().driving, error.rms(), error.greatest);
  };
  const auto single = Simulation::make(scene, 1);
  advance_to(*single, 0.003);
  REQUIRE(std::abs(single->energies().driving) > 0);

  const auto simulation = on_all_ranks(scene, n_threads);
  advance_to(*simulation, 0.003);

  CHECK(outcome(*simulation) == outcome(*single));
}

TEST_CASE("patches that follow the load to other ranks change no bit", "[ranks]")
{
  const Scene scene = glancing_disks();
  const auto simulation = on_all_ranks(scene, 2);
  simulation->engine().balance_every(5);

  advance_to(*simulation, 0.3);

  CHECK(ending(*simulation) == alone(scene, 0.3));
  // The disks move on and leave, and the load with them.
  const bool several = simulation->communicator().size() > 1;
  CHECK(simulation->engine().rebalances().empty() != several);
  for (const runtime::Rebalance& r : simulation->engine().rebalances())
    CHECK(r.imbalance_expected < r.imbalance_before);
}

TEST_CASE("a particle that goes wrong on one rank is the same error on all", "[ranks]")
{
  Scene scene = glancing_disks();
  // From then on a corner of the first disk is pushed by what is not a number.
  scene.bodies[0].functions.body_force = [](const Vector<3>& X, double t) {
    return Vector<3>(t > 0.02 && X[0] < 0.6 && X[1] < 0.6 ? std::nan("") : 0.0, 0, 0);
  };
  const auto message_of = [](Simulation& simulation) -> std::string {
    try {
      advance_to(simulation, 0.1);
    } catch (const SimulationError& error) {
      return error.what();
    }
    return "nothing went wrong";
  };

  const auto simulation = on_all_ranks(scene, 2);
  const std::string message = message_of(*simulation);

  const auto single = Simulation::make(scene, 1);
  CHECK_THAT(message, Catch::Contains("particle") && Catch::Contains("elastic 0"));
  for (const std::string& other : simulation->communicator().gather(message)) CHECK(other == message);
  message_of(*single);
  // The state of the last good step is still there.
  CHECK(simulation->n_steps() > 1);
  CHECK(simulation->n_steps() == single->n_steps());
  CHECK(simulation->digest() == single->digest());
}

}  // namespace test_on_ranks
