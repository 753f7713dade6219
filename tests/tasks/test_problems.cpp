#include <catch2/catch.hpp>
#include <numbers>

#include "components/problems/problem.hpp"
#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_problems
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double pi = std::numbers::pi;

/// Young's modulus 1e4 Pa, Poisson's ratio 0.3.
const components::NeoHookean soft{1e4 / 1.2, 1e4 / 2.6};

/// A block of 1 m between smooth walls that moves along its first axes by the manufactured solution; one row of cells
/// in the plane where it moves along one axis.
Scene aligned_block(int dimension, int n_axes, int n_cells, double amplitude)
{
  const int n_across = n_axes == 1 ? 1 : n_cells;
  Scene scene = empty_scene(dimension, {n_cells, n_across, dimension == 3 ? n_cells : 1}, 1.0 / n_cells);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) add_walls(scene, k);
  scene.materials.push_back({"soft", 1, soft});
  SceneBody& body = add_box(scene, 0, {0, 0, 0}, {1, 1, 1});
  const components::AxisAligned problem{.amplitude = amplitude, .length = 1, .n_axes = n_axes};
  body.functions = problem.functions({dimension, 1, scene.materials[0].model});
  scene.time.multiplier = 0.4;
  return scene;
}

struct WorstError {
  double rms = 0;
  double greatest = 0;
};

/// Over a run, of the first body.
WorstError worst_error(const Scene& scene, double whole)
{
  const double end = end_of(whole);
  const auto simulation = Simulation::make(scene, 2);
  WorstError worst;
  while (simulation->time() < end) {
    simulation->advance(end);
    const DisplacementError error = simulation->report().displacement_errors[0];
    worst.rms = std::max(worst.rms, error.rms());
    worst.greatest = std::max(worst.greatest, error.greatest);
  }
  return worst;
}

/// Half a period of the solution, in which every axis comes to its largest displacement.
constexpr double half_period = 0.01;

}  // namespace

TEST_CASE("the error against the axis-aligned solution is of second order in the cell size where strains are small",
          "[slow][pinned]")
{
  struct Block {
    int dimension, n_axes;
    Interpolator interpolator;
    Transfer transfer;
    std::vector<int> n_cells;
    /// Bounds of the coarsest block's error, relative to the amplitude: pinned just above what the program gave
    /// (results/verification/axis_aligned_quick.csv). The order is held against theory.
    WorstError bound;
  };
  const auto block =
      GENERATE(Block{2, 1, Interpolator("gimp"), Transfer("flip"), {8, 16, 32}, {0.040, 0.056}},
               Block{2, 2, Interpolator("gimp"), Transfer("flip"), {8, 16, 32}, {0.042, 0.058}},
               Block{2, 2, Interpolator("gimp"), Transfer("tflip"), {8, 16, 32}, {0.016, 0.023}},
               Block{2, 2, Interpolator("quadratic_spline"), Transfer("flip"), {8, 16, 32}, {0.097, 0.136}},
               Block{3, 3, Interpolator("gimp"), Transfer("flip"), {8, 16}, {0.051, 0.071}});
  constexpr double amplitude = 1e-3;
  std::vector<WorstError> errors;
  for (const int n : block.n_cells) {
    Scene scene = aligned_block(block.dimension, block.n_axes, n, amplitude);
    scene.interpolator = block.interpolator;
    scene.transfer = block.transfer;

    errors.push_back(worst_error(scene, half_period));
    INFO("errors of " << n << " cells: " << errors.back().rms / amplitude << ", "
                      << errors.back().greatest / amplitude);
    CHECK(errors.back().rms > 0);
  }

  if (is_rehearsal) return;
  CHECK(errors[0].rms < block.bound.rms * amplitude);
  CHECK(errors[0].greatest < block.bound.greatest * amplitude);
  for (std::size_t k = 1; k < errors.size(); ++k) {
    CHECK(std::log2(errors[k - 1].rms / errors[k].rms) == Approx(2).margin(0.06));
    CHECK(std::log2(errors[k - 1].greatest / errors[k].greatest) == Approx(2).margin(0.06));
  }
}

TEST_CASE("at strains of 16 % particles of constant size keep the error from falling with its second order", "[pinned]")
{
  // They overlap and leave gaps where the block is strained.
  std::vector<WorstError> errors;
  for (const int n : {8, 16, 32}) errors.push_back(worst_error(aligned_block(2, 2, n, 0.05), half_period));

  if (is_rehearsal) return;
  // Pinned from results/verification/axis_aligned_quick.csv; particles that deform are held to second order below.
  CHECK(errors[0].rms < 0.069 * 0.05);
  CHECK(std::log2(errors[0].rms / errors[1].rms) == Approx(1.87).margin(0.02));
  CHECK(std::log2(errors[1].rms / errors[2].rms) == Approx(1.63).margin(0.02));
  CHECK(std::log2(errors[1].greatest / errors[2].greatest) == Approx(1.47).margin(0.02));
}

TEST_CASE("particles whose size follows the deformation, and cubic splines, keep second order at strains of 16 %",
          "[slow]")
{
  const Interpolator interpolator =
      GENERATE(Interpolator("cpgimp"), Interpolator("cpdi"), Interpolator("cubic_spline"));
  const int dimension = GENERATE(2, 3);
  const std::vector<int> n_cells = dimension == 2 ? std::vector{12, 24} : std::vector{8, 12};
  std::vector<WorstError> errors;
  for (const int n : n_cells) {
    Scene scene = aligned_block(dimension, dimension, n, 0.05);
    scene.interpolator = interpolator;
    errors.push_back(worst_error(scene, half_period));
  }

  const double order =
      std::log(errors.front().rms / errors.back().rms) / std::log(1.0 * n_cells.back() / n_cells.front());
  if (is_rehearsal) return;
  CHECK(order > (dimension == 2 ? 1.95 : 1.9));
  CHECK(order < 2.2);
}

namespace
{

/// The published vortex in the middle of a plane, its particles on rings.
Scene vortex_scene(int n_cells, const Vector<3>& velocity)
{
  Scene scene = empty_scene(2, {n_cells, n_cells, 1}, 3.0 / n_cells);
  scene.materials.push_back({"soft", 1000, components::NeoHookeanLog{1e3 / 1.2, 1e3 / 2.6}});
  SceneBody& body = add_disk(scene, 0, 1.5, 1.5, 1.25, {0, 0, 0});
  const components::Vortex problem{.centre = {1.5, 1.5, 0},
                                   .inner_radius = 0.75,
                                   .outer_radius = 1.25,
                                   .angle = 1,
                                   .period = 2,
                                   .velocity = velocity};
  body.functions = problem.functions({2, 1000, scene.materials[0].model});
  scene.interpolator = Interpolator("quadratic_spline");
  scene.time.multiplier = 0.4;
  return scene;
}

/// The published ring, but for its amplitude.
Scene ring_scene(int n_cells, double amplitude)
{
  Scene scene = empty_scene(2, {n_cells, n_cells, 1}, 1.6 / n_cells);
  scene.materials.push_back({"soft", 1000, components::NeoHookeanLog{1e7 / 3, 5e6}});
  SceneBody& body = add_disk(scene, 0, 0.8, 0.8, 0.6, {0, 0, 0});
  const components::Ring problem{
      .centre = {0.8, 0.8, 0}, .inner_radius = 0.4, .outer_radius = 0.6, .amplitude = amplitude};
  body.functions = problem.functions({2, 1000, scene.materials[0].model});
  scene.interpolator = Interpolator("quadratic_spline");
  scene.time.multiplier = 0.4;
  return scene;
}

}  // namespace

TEST_CASE("the error against the vortex falls with the cell size, at rest and carried along alike", "[pinned]")
{
  const Vector<3> velocity = GENERATE(Vector<3>(0, 0, 0), Vector<3>(0.3, -0.2, 0));

  // Until the middle has turned by a radian; it is then displaced by 0.96 m.
  const double coarse = worst_error(vortex_scene(30, velocity), 0.5).rms;
  const double fine = worst_error(vortex_scene(60, velocity), 0.5).rms;

  if (is_rehearsal) return;
  // Second order, less what rims across the cells cost with 2 particles an axis; pinned from an error of 0.062 and an
  // order of 1.45. The studies vortex and vortex_drifting of inputs/verification hold orders against theory.
  CHECK(coarse < 0.065);
  CHECK(std::log2(coarse / fine) > 1.4);
}

TEST_CASE("the error against the ring falls with the cell size where strains are small", "[pinned]")
{
  constexpr double amplitude = 1e-3, quarter_period = 0.005;

  const double coarse = worst_error(ring_scene(32, amplitude), quarter_period).rms / amplitude;
  const double fine = worst_error(ring_scene(64, amplitude), quarter_period).rms / amplitude;

  if (is_rehearsal) return;
  // Its free rims do not lie on nodes. Pinned from an error of 1.54e-3 and an order of 1.72; the study ring of
  // inputs/verification holds orders against theory.
  CHECK(coarse < 1.6e-3);
  CHECK(std::log2(coarse / fine) > 1.6);
}

TEST_CASE("parallelograms along the sectors in which particles lie keep their order at hoop strains of 26 %",
          "[pinned]")
{
  constexpr double amplitude = 0.1;
  const auto error_of = [&](int n_cells) {
    Scene scene = ring_scene(n_cells, amplitude);
    scene.interpolator = Interpolator("cpdi");
    return worst_error(scene, half_period).rms / amplitude;
  };

  const double coarse = error_of(32), fine = error_of(64);

  if (is_rehearsal) return;
  // Along the grid they would overlap and leave gaps from the start. The error is pinned; the order is the bar of the
  // study ring of inputs/verification.
  CHECK(coarse < 0.012);
  CHECK(std::log2(coarse / fine) > 1.7);
}

TEST_CASE("the error against the compacted column is of second order where it is elastic and strains are small",
          "[pinned]")
{
  constexpr double compaction = 2e-3, displacement = 0.4 * compaction / 2;
  const auto error_of = [&](int n_cells) {
    Scene scene = empty_scene(2, {n_cells + n_cells / 10, 4, 1}, 0.4 / n_cells);
    scene.faces[0][0] = components::SymmetryFace();
    add_walls(scene, 1);
    scene.materials.push_back({"elastic", 1624, components::Hypoelastic{4e8, 3e8}});
    SceneBody& body = add_box(scene, 0, {0, 0, 0}, {0.4, 1.6 / n_cells, 0});
    const components::CompactedColumn problem{.length = 0.4, .compaction = compaction, .duration = 4e-3};
    body.functions = problem.functions({2, 1624, scene.materials[0].model});
    scene.interpolator = Interpolator("quadratic_spline");
    scene.time.multiplier = 0.4;
    return worst_error(scene, 4e-3).rms / displacement;
  };

  const double coarse = error_of(20), fine = error_of(40);

  if (is_rehearsal) return;
  // Pinned from 5.29e-4; the order is held against theory.
  CHECK(coarse < 5.5e-4);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.03));
}

TEST_CASE("the error against the cavity falls with the cell size where strains are small, its rims under pressure",
          "[pinned]")
{
  constexpr double expansion = 2e-3, displacement = 0.4 * expansion;
  const auto error_of = [&](int n_cells) {
    Scene scene = empty_scene(2, {n_cells, n_cells, 1}, 1.6 / n_cells);
    scene.materials.push_back({"elastic", 1000, components::Hypoelastic{8e6, 5e6}});
    SceneBody& body = add_disk(scene, 0, 0.8, 0.8, 0.6, {0, 0, 0});
    const components::Cavity problem{.centre = {0.8, 0.8, 0},
                                     .inner_radius = 0.4,
                                     .outer_radius = 0.6,
                                     .expansion = expansion,
                                     .shortening = 2,
                                     .duration = 2e-3};
    body.functions = problem.functions({2, 1000, scene.materials[0].model});
    scene.interpolator = Interpolator("quadratic_spline");
    scene.time.multiplier = 0.4;
    return worst_error(scene, 2e-3).rms / displacement;
  };

  const double coarse = error_of(32), fine = error_of(64);

  if (is_rehearsal) return;
  // Pinned from an error of 0.0217 and an order of 1.92; the study cavity of inputs/verification has bars of its own.
  CHECK(coarse < 0.023);
  CHECK(std::log2(coarse / fine) > 1.8);
}

namespace
{

/// The kinetic energy, with what materials have stored of it and at the start.
double energy_of(Simulation& simulation)
{
  return simulation.report().kinetic + simulation.energies().elastic;
}

/// The greatest distance between particles of the same ids.
double farthest_apart(const std::vector<Particle>& a, const std::vector<Particle>& b)
{
  REQUIRE(a.size() == b.size());
  double farthest = 0;
  for (std::size_t p = 0; p < a.size(); ++p) farthest = std::max(farthest, (a[p].position - b[p].position).norm());
  return farthest;
}

components::BodyFunctions::OfTime constant(const Triple& b)
{
  return [b](const Vector<3>&, double) { return Vector<3>(b[0], b[1], b[2]); };
}

}  // namespace

TEST_CASE("a constant body force is gravity, to round-off: in motion, work and momentum")
{
  // Two blocks meet and rub on each other as they fall; one slides between smooth walls.
  const bool between_walls = GENERATE(false, true);
  const Triple g{60, between_walls ? 0.0 : -90.0, 0};
  Scene scene = empty_scene(2, {24, between_walls ? 4 : 24, 1}, 0.1);
  scene.n_patches = {3, between_walls ? 1 : 2, 1};
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  // The work of gravity until the end depends on the last step too, and so on round-off in its bound.
  scene.time.maximum_step = 5e-4;
  add_elastic(scene, 1000, 1e5, 0.3);
  add_elastic(scene, 1500, 3e5, 0.2);
  if (between_walls) {
    add_walls(scene, 1);
    add_box(scene, 0, {0.2, 0, 0}, {1.0, 0.4, 0}, {1, 0, 0});
  } else {
    add_box(scene, 0, {0.6, 1.2, 0}, {1.1, 1.8, 0}, {2, 0, 0});
    add_box(scene, 1, {1.15, 1.3, 0}, {1.5, 1.7, 0});
    scene.contacts.push_back({0, 1, 0.3});
  }
  Scene by_function = scene;
  scene.gravity = g;
  for (SceneBody& body : by_function.bodies) body.functions.body_force = constant(g);
  const auto one = Simulation::make(scene, 2), other = Simulation::make(by_function, 2);
  const double work_function = one->report().gravity_work;
  const auto start = particles_of(*one);

  advance_to(*one, 0.08);
  advance_to(*other, 0.08);

  CHECK(farthest_apart(start, particles_of(*one)) > 0.1);
  CHECK(farthest_apart(particles_of(*other), particles_of(*one)) < 1e-12);
  CHECK(other->energies().driving == Approx(one->report().gravity_work - work_function).epsilon(1e-12));
  CHECK(one->energies().driving == 0);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(other->grid_totals().impulse[k] == Approx(one->grid_totals().impulse[k]).epsilon(1e-12).margin(1e-9));
  }
}

TEST_CASE("half of a block that a body force draws out symmetrically, at a wall, moves as in the whole block")
{
  Scene whole = empty_scene(2, {24, 8, 1}, 0.1);
  whole.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  add_elastic(whole, 1000, 1e5, 0.3);
  // Off the lattice of cells, so that particles near the wall reach behind it.
  whole.grid.lower = {-1.2, 0, 0};
  whole.particles_per_axis = 3;
  add_box(whole, 0, {-0.7, 0.2, 0}, {0.7, 0.6, 0}).functions.body_force = [](const Vector<3>& X, double t) {
    return Vector<3>(200 * std::sin(3 * X[0]) * std::cos(100 * t), 0, 0);
  };
  Scene half = whole;
  half.grid.lower[0] = 0;
  half.grid.n_cells[0] = 12;
  half.faces[0][0] = components::SymmetryFace();
  whole.time.maximum_step = half.time.maximum_step = 5e-4;
  const auto of_whole = Simulation::make(whole, 2), of_half = Simulation::make(half, 1);

  advance_to(*of_whole, 0.03);
  advance_to(*of_half, 0.03);

  std::vector<Particle> right;
  for (const Particle& p : particles_of(*of_whole)) {
    if (p.position[0] > 0) right.push_back(p);
  }
  const auto found = particles_of(*of_half);
  REQUIRE(right.size() == found.size());
  double farthest = 0, fastest = 0;
  for (const Particle& p : found) {
    double nearest = 1;
    for (const Particle& q : right) nearest = std::min(nearest, (p.position - q.position).norm());
    farthest = std::max(farthest, nearest);
    fastest = std::max(fastest, p.velocity.norm());
  }
  CHECK(fastest > 0.5);
  CHECK(farthest < 1e-12);
  CHECK(2 * of_half->energies().driving == Approx(of_whole->energies().driving).epsilon(1e-11));
}

TEST_CASE("the work of a body force is what a block that it drives gains in motion and in store")
{
  Scene scene = aligned_block(2, 2, 32, 0.02);
  scene.transfer = Transfer("tflip");
  const auto simulation = Simulation::make(scene, 2);
  const double start = energy_of(*simulation);

  advance_to(*simulation, 0.6 * half_period);
  const double energy_before = energy_of(*simulation), work = simulation->energies().driving,
               kinetic_before = simulation->report().kinetic;
  simulation->advance(1e30);

  // Velocities are those of half a step before.
  const double energy = energy_before + 0.5 * (simulation->report().kinetic - kinetic_before);
  CHECK(work > 0.1 * start);
  CHECK(energy - start == Approx(work).epsilon(0.03));
}

TEST_CASE("what particles gain is what the grid gives them, body forces too")
{
  Scene scene = aligned_block(2, 2, 8, 0.02);
  const auto simulation = Simulation::make(scene, 2);
  const ParticleReport before = simulation->report();

  advance_to(*simulation, 0.003);

  const Eigen::Vector3d gained = simulation->report().momentum() - before.momentum();
  const Eigen::Vector3d given = Eigen::Map<const Eigen::Vector3d>(simulation->grid_totals().impulse.data());
  CHECK(gained.norm() > 0.1 * before.momentum().norm());
  CHECK((gained - given).norm() < 1e-12 * before.momentum().norm());
}

TEST_CASE("a bar that starts strained has the mass, the stress and the energy of its strain, and swings by them")
{
  // In one row: u = A sin(pi X), of large strains; released from rest.
  constexpr double A = 0.05;
  Scene scene = aligned_block(2, 1, 32, A);
  scene.bodies[0].functions = {};
  scene.bodies[0].functions.displacement = [](const Vector<3>& X) { return Vector<3>(A * std::sin(pi * X[0]), 0, 0); };
  scene.bodies[0].functions.deformation_gradient = [](const Vector<3>& X) -> Matrix<3> {
    return Vector<3>(1 + A * pi * std::cos(pi * X[0]), 1, 1).asDiagonal();
  };
  const auto simulation = Simulation::make(scene, 1);

  // With l = 1 + pi A cos(pi X) and row height h, W from its closed form, by the midpoint rule.
  constexpr double h = 1.0 / 32;
  const double K = soft.bulk_modulus, G = soft.shear_modulus;
  double stored = 0;
  for (int i = 0; i < 2000; ++i) {
    const double l = 1 + pi * A * std::cos(pi * (i + 0.5) / 2000);
    stored += h / 2000 *
              (0.5 * K * (0.5 * (l * l - 1) - std::log(l)) + 0.5 * G * (std::pow(l, -2.0 / 3.0) * (l * l + 2) - 3));
  }
  CHECK(simulation->energies().elastic == Approx(stored).epsilon(1e-4));
  CHECK(total_mass(simulation->report()) == Approx(h));
  for (const Particle& p : particles_of(*simulation)) {
    const double l = p.volume_ratio;
    REQUIRE(p.density == Approx(1 / l));
    const double stress = 0.5 * K * (l - 1 / l) + G * std::pow(l, -5.0 / 3.0) * 2 * (l * l - 1) / 3;
    REQUIRE(p.stress[0] == Approx(stress).margin(1e-9));
    REQUIRE((p.position[0] > 0 && p.position[0] < 1));
  }

  double most_kinetic = 0, error = 0;
  while (simulation->time() < 0.04) {
    simulation->advance(0.04);
    most_kinetic = std::max(most_kinetic, simulation->report().kinetic);
    error = std::max(error, std::abs(energy_of(*simulation) - stored));
  }
  CHECK(most_kinetic > 0.9 * stored);
  CHECK(error < 0.05 * stored);
}

TEST_CASE("a disk that a body force holds on its circles turns as the exact one, with its angular momentum")
{
  const double inner = GENERATE(0.0, 0.15);
  Scene scene = empty_scene(2, {30, 30, 1}, 1.0 / 30);
  scene.transfer = Transfer("tflip");
  scene.materials.push_back({"soft", 1000, components::NeoHookean{1e6, 5e5}});
  SceneBody& body = add_disk(scene, 0, 0.5, 0.5, 0.4, {0, 0, 0});
  const components::RotatingDisk problem{
      .centre = {0.5, 0.5, 0}, .outer_radius = 0.4, .angular_speed = 10, .inner_radius = inner};
  body.functions = problem.functions({2, 1000, scene.materials[0].model});
  const auto simulation = Simulation::make(scene, 2);
  const double mass = total_mass(simulation->report());
  const auto angular_momentum = [&] {
    const BodySums sums = simulation->report().bodies[0];
    return sums.angular_momentum[2] - sums.position.cross(sums.momentum)[2] / sums.mass;
  };
  const double at_start = angular_momentum();

  advance_to(*simulation, 0.1);

  CHECK(mass == Approx(1000 * pi * (0.16 - inner * inner)).epsilon(1e-13));
  CHECK(at_start == Approx(10 * 500 * pi * (0.0256 - std::pow(inner, 4))).epsilon(2e-3));
  CHECK(angular_momentum() == Approx(at_start).epsilon(1e-3));
  const DisplacementError error = simulation->report().displacement_errors[0];
  // Its rim has moved by 0.38 m, in a radian.
  CHECK(simulation->report().bodies[0].tilt(2) == Approx(1).epsilon(1e-3));
  CHECK(error.rms() < 1e-3);
  CHECK(error.mass == Approx(mass));
}

}  // namespace test_problems
