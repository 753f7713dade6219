#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_stress_timing
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double pi = std::numbers::pi;

/// A block at rest between smooth walls, of 8 cells of 0.1 m along x, which a body force pulls at in a wave of `k`.
Scene pulled_block(int dimension, double k)
{
  Scene scene = empty_scene(dimension, {8, 3, dimension == 3 ? 3 : 1}, 0.1);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) add_walls(scene, axis);
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), {0, 0, 0}, {1, 1, 1}).functions.body_force =
      [k](const Vector<3>& X, double) { return Vector<3>(std::sin(k * X[0]), 0, 0); };
  scene.time.maximum_step = 1e-4;
  return scene;
}

/// Changes of the volumes of particles after some steps.
std::vector<double> strains_after(Scene scene, StressTiming timing, int n_steps)
{
  scene.stress_timing = timing;
  const auto simulation = Simulation::make(scene, 1);
  for (int i = 0; i < n_steps; ++i) simulation->advance(1e30);
  std::vector<double> strains;
  for (const Particle& p : particles_of(*simulation)) strains.push_back(p.volume_ratio - 1);
  return strains;
}

}  // namespace

TEST_CASE("from rest a force deforms particles by what the nodes tell them, by what they bring back of it, or not yet")
{
  // Particles bring back the part (5 + 3 cos kh) / 8 of a wave, see docs/explanation/method.md.
  const double k = GENERATE(1, 3, 6) * pi / 0.8;
  const Scene scene = pulled_block(GENERATE(2, 3), k);
  const double part = (5 + 3 * std::cos(k * 0.1)) / 8;

  const auto usl = strains_after(scene, StressTiming::usl, 1);
  const auto musl = strains_after(scene, StressTiming::musl, 1);
  const auto usf = strains_after(scene, StressTiming::usf, 1);
  const auto next_usf = strains_after(scene, StressTiming::usf, 2);

  const double greatest = *std::max_element(usl.begin(), usl.end());
  REQUIRE(greatest > 1e-9);
  for (std::size_t p = 0; p < usl.size(); ++p) {
    REQUIRE(musl[p] == Approx(part * usl[p]).margin(1e-6 * greatest));
    REQUIRE(usf[p] == 0);
    REQUIRE(next_usf[p] == Approx(part * usl[p]).margin(1e-6 * greatest));
  }
}

namespace
{

/// A disk that flies along a no-slip wall and meets one of another material, both under pressure and pulled
/// at; `is_rigid`: the other keeps its shape.
Scene meeting_disks(bool is_rigid)
{
  Scene scene = empty_scene(2, {18, 12, 1}, 0.1);
  scene.n_patches = {3, 2, 1};
  scene.faces[1] = {components::NoSlipWall(), components::SymmetryFace()};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  const int soft = add_elastic(scene, 1000, 1e6, 0.3), hard = add_elastic(scene, 2000, 4e6, 0.2);
  SceneBody& first = add_disk(scene, soft, 0.55, 0.42, 0.4, {6, -0.5, 0});
  first.pressure = BodyPressure{components::PressureCurve({{0, 1e3}, {0.1, 1e4}})};
  first.functions.body_force = [](const Vector<3>& X, double t) { return Vector<3>(0, 100 * X[0] - 1e3 * t, 0); };
  add_disk(scene, hard, 1.35, 0.6, 0.35, {-6, 0, 0}).rigid = is_rigid;
  return scene;
}

double all_energy(Simulation& simulation)
{
  const EnergyLedger& now = simulation.energies();
  return simulation.report().kinetic + now.elastic + now.plastic + now.viscous + now.contact + now.filter - now.driving;
}

}  // namespace

TEST_CASE("where stress works at velocities of its own, the difference is filtered out and all energy is there")
{
  Scene scene = meeting_disks(false);
  scene.stress_timing = GENERATE(StressTiming::usf, StressTiming::musl);
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  scene.local_damping = 0.05;
  const auto simulation = Simulation::make(scene, 1);
  const double at_start = all_energy(*simulation);

  advance_to(*simulation, 0.05);

  REQUIRE(simulation->lost().count == 0);
  const EnergyLedger& energies = simulation->energies();
  CHECK(std::abs(energies.driving) > 1e-3 * at_start);
  CHECK(energies.contact > 1e-3 * at_start);
  CHECK(all_energy(*simulation) == Approx(at_start).epsilon(1e-12));
}

TEST_CASE("whenever stress follows, disks meet with the same bits on any ranks and threads", "[ranks]")
{
  const auto [timing, transfer, anti_locking, is_rigid, n_threads] =
      GENERATE(std::tuple{StressTiming::usf, Transfer("flip"), AntiLocking::cell_average, false, 2},
               std::tuple{StressTiming::usf, Transfer("tpic"), AntiLocking::none, true, 3},
               std::tuple{StressTiming::musl, Transfer("tflip"), AntiLocking::cell_average, false, 1},
               std::tuple{StressTiming::musl, Transfer("apic"), AntiLocking::f_bar, false, 2},
               std::tuple{StressTiming::musl, Transfer("fmpm"), AntiLocking::none, true, 2});
  Scene scene = meeting_disks(is_rigid);
  scene.stress_timing = timing;
  scene.transfer = transfer;
  scene.anti_locking = anti_locking;
  const auto alone = Simulation::make(scene, 1);
  advance_to(*alone, 0.04);

  const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                                           runtime::Communicator::world());
  advance_to(*simulation, 0.04);

  CHECK(simulation->digest() == alone->digest());
  CHECK(simulation->energies().filter == alone->energies().filter);
}

}  // namespace test_stress_timing
