#include <catch2/catch.hpp>

#include <numbers>
#include <utility>

#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_periodic
{

/// Domains of which some axes have no ends: what leaves at one face enters at the other.
using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double pi = std::numbers::pi;

std::vector<double> numbers_of(const std::vector<runtime::Column>& columns, const std::string& name)
{
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const auto& column) { return column.name == name; });
  const auto values = std::get<std::span<const double>>(at->values);
  return {values.begin(), values.end()};
}

/// Particles as they would be had nothing put them back.
std::vector<Particle> travelled(Simulation& simulation)
{
  std::vector<Particle> particles = particles_of(simulation);
  const runtime::Grid& grid = simulation.scene().grid;
  const auto n_axes = static_cast<std::size_t>(grid.dimension);
  const auto blocks = simulation.particle_columns();
  for (const runtime::ParticleBlock& block : blocks) {
    const auto id = std::get<std::span<const std::int64_t>>(block.columns.front().values);
    const auto laps = numbers_of(block.columns, "laps");
    for (std::size_t p = 0; p < block.n; ++p) {
      // Ids count from 0.
      Eigen::Vector3d& x = particles[static_cast<std::size_t>(id[p])].position;
      for (std::size_t k = 0; k < n_axes; ++k) x[static_cast<int>(k)] += laps[n_axes * p + k] * grid.length(k);
    }
  }
  return particles;
}

}  // namespace

TEST_CASE("matter that fills a periodic domain flies around in it undeformed", "[slow]")
{
  const int dimension = GENERATE(2, 3);
  const runtime::Index n_patches = GENERATE(runtime::Index{1, 1, 1}, runtime::Index{2, 1, 1}, runtime::Index{3, 2, 1});
  Scene scene = empty_scene(dimension, {12, 6, dimension == 3 ? 3 : 1}, 0.05);
  scene.grid.lower = {-0.1, 0.2, 0.7};
  scene.grid.periodic = {true, true, dimension == 3};
  scene.n_patches = n_patches;
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const Eigen::Vector3d v(3, -1.7, dimension == 3 ? 0.9 : 0);
  add_box(scene, add_elastic(scene, 7800, 2e5, 0.3), {-9, -9, -9}, {9, 9, 9}, {v[0], v[1], v[2]});
  const auto simulation = Simulation::make(scene, 2);
  const auto before = particles_of(*simulation);
  const double mass = total_mass(simulation->report());
  CHECK(mass == Approx(7800 * 0.6 * 0.3 * (dimension == 3 ? 0.15 : 1)));

  // Two and a half times around along x, nearly three times back along y.
  advance_to(*simulation, end_of(0.5));

  const auto after = travelled(*simulation);
  REQUIRE(after.size() == before.size());
  for (std::size_t p = 0; p < after.size(); ++p) {
    REQUIRE((after[p].velocity - v).norm() < 1e-12);
    REQUIRE((after[p].position - before[p].position - v * simulation->time()).norm() < 1e-12);
    REQUIRE(std::abs(after[p].volume_ratio - 1) < 1e-12);
    for (const double s : after[p].stress) REQUIRE(std::abs(s) < 1e-11 * 2e5);
  }
  const ParticleReport report = simulation->report();
  CHECK((report.momentum() - mass * v).norm() < 1e-12 * mass);
  CHECK(simulation->lost().count == 0);
}

namespace
{

/// Two disks, one harder, that run into each other and glance off while both drift on; along x the domain is periodic
/// or so long that they stay within it.
Scene drifting_disks(bool periodic, int n_patches)
{
  Scene scene = empty_scene(2, {periodic ? 24 : 96, 16, 1}, 0.125);
  scene.grid.periodic[0] = periodic;
  scene.n_patches = {periodic ? n_patches : 4, 2, 1};
  scene.faces[1] = {components::SymmetryFace(), components::OpenFace()};
  scene.contacts.push_back({0, 1, 0.3});
  scene.artificial_viscosity = components::ArtificialViscosity{};
  const int soft = add_elastic(scene, 1000, 1e6, 0.3), hard = add_elastic(scene, 2000, 4e6, 0.2);
  add_disk(scene, soft, 1.2, 0.8, 0.5, {64, -0.5, 0});
  add_disk(scene, hard, 2.4, 1.0, 0.5, {54, 0, 0});
  scene.gravity = {0, -9.81, 0};
  return scene;
}

}  // namespace

TEST_CASE("bodies collide across the ends of a periodic domain as they do in the middle of a long one")
{
  const int n_patches = GENERATE(1, 2, 4);
  const Transfer transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  const auto make = [&](bool periodic) {
    Scene scene = drifting_disks(periodic, n_patches);
    scene.transfer = transfer;
    return Simulation::make(scene, 2);
  };
  const auto around = make(true), along = make(false);

  // Contact makes differences of round-off grow; later on cuts of the long domain differ by as much as that.
  advance_to(*around, 0.022);
  advance_to(*along, 0.022);

  REQUIRE(along->lost().count == 0);
  CHECK(around->lost().count == 0);
  CHECK(around->n_steps() == along->n_steps());
  const auto there = travelled(*around), expected = particles_of(*along);
  REQUIRE(there.size() == expected.size());
  double moved = 0, apart = 0, velocities_apart = 0, stresses_apart = 0;
  for (std::size_t p = 0; p < there.size(); ++p) {
    moved = std::max(moved, there[p].position[0]);
    apart = std::max(apart, (there[p].position - expected[p].position).norm());
    velocities_apart = std::max(velocities_apart, (there[p].velocity - expected[p].velocity).norm());
    for (std::size_t s = 0; s < 6; ++s)
      stresses_apart = std::max(stresses_apart, std::abs(there[p].stress[s] - expected[p].stress[s]));
  }
  // The face at 3 m is in their midst.
  CHECK(moved > 3.5);
  CHECK(along->energies().contact > 100);
  CHECK(apart < 1e-9);
  CHECK(velocities_apart < 1e-7);
  CHECK(stresses_apart < 1e-7 * 1e6);
  const BodySums body = around->report().bodies[1], other = along->report().bodies[1];
  CHECK((body.position - other.position).norm() < 1e-9 * other.position.norm());
  CHECK(body.spin()[2] == Approx(other.spin()[2]).margin(1e-7));
  CHECK(body.tilt(2) == Approx(other.tilt(2)).margin(1e-9));
  CHECK(around->energies().contact == Approx(along->energies().contact).epsilon(1e-6));
}

TEST_CASE("a body falls around a periodic domain, and its energy and momentum are accounted for")
{
  Scene scene = empty_scene(2, {8, 10, 1}, 0.1);
  scene.grid.periodic[1] = true;
  scene.n_patches = {1, 2, 1};
  scene.gravity = {0, -10, 0};
  add_box(scene, add_elastic(scene, 2000, 1e6, 0.2), {0.2, 0.1, 0}, {0.6, 0.5, 0}, {0, 1, 0});
  const auto simulation = Simulation::make(scene, 1);
  const ParticleReport start = simulation->report();
  const double mass = start.bodies[0].mass;

  advance_to(*simulation, 1);

  const ParticleReport now = simulation->report();
  const Eigen::Vector3d way = (now.bodies[0].position - now.bodies[0].reference_position) / mass;
  CHECK(way[1] == Approx(1 - 5).epsilon(1e-11));
  CHECK(std::abs(way[0]) < 1e-12);
  CHECK(std::abs(now.bodies[0].tilt(2)) < 1e-10);
  CHECK(now.gravity_work - start.gravity_work == Approx(mass * 10 * 4).epsilon(1e-11));
  const double half_step = 0.5 * simulation->last_step_size();
  CHECK(now.momentum()[1] == Approx(mass * (1 - 10 * (1 - half_step))).epsilon(1e-12));
  CHECK(simulation->grid_totals().impulse[1] == Approx(now.momentum()[1] - mass).epsilon(1e-12));
}

TEST_CASE("the field of nodes shows the nodes of both ends of a periodic domain, with the same values")
{
  const int n_patches = GENERATE(1, 2);
  Scene scene = empty_scene(2, {8, 4, 1}, 0.1);
  scene.grid.periodic[0] = true;
  scene.n_patches = {n_patches, 1, 1};
  add_disk(scene, add_elastic(scene, 2000, 1e6, 0.2), 0.7, 0.2, 0.1, {1, 0.1, 0});
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 0.08);

  const runtime::FieldCopy fields = simulation->fields({}, true);
  const runtime::NodeBlock& block = fields.nodes.value();
  const auto density = numbers_of(block.columns, "density"), velocity = numbers_of(block.columns, "velocity");
  std::array<std::array<double, 3>, 5> first{}, last{};
  int n_nodes = 0;
  for (const runtime::IndexBox& box : block.boxes.value()) {
    for_each(box, [&](const runtime::Index& i) {
      const auto n = static_cast<std::size_t>(n_nodes++), j = static_cast<std::size_t>(i[1]);
      if (i[0] == 0) first[j] = {density[n], velocity[2 * n], velocity[2 * n + 1]};
      if (i[0] == 8) last[j] = {density[n], velocity[2 * n], velocity[2 * n + 1]};
    });
  }
  CHECK(n_nodes == 9 * 5);
  CHECK(first == last);
  CHECK(first[2][0] > 0);
  CHECK(first[2][1] == Approx(1));
}

namespace
{

constexpr double density = 1;
constexpr double poisson = 0.25;
/// Modulus of uniaxial strain: waves run at 10 m/s lengthwise and at 10 / sqrt 3 across.
constexpr double modulus = 100;
constexpr double length = 32;

/// A bar along x, 4 cells wide, without ends; all velocities are small beside `drift`.
Scene endless_bar(int n_cells)
{
  Scene scene = empty_scene(2, {n_cells, 4, 1}, length / n_cells);
  scene.grid.periodic = {true, true, false};
  add_box(scene, add_elastic(scene, density, modulus / uniaxial_modulus(1, poisson), poisson), {0, 0, 0},
          {length, 1e9, 0});
  return scene;
}

/// Amplitude of sin(k x) in the velocities along `axis`, x where each particle started.
double mode(const std::vector<Particle>& start, const std::vector<Particle>& now, double k, int axis, double drift)
{
  double sum = 0, norm = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const double shape = std::sin(k * start[p].position[0]);
    sum += shape * (now[p].velocity[axis] - drift);
    norm += shape * shape;
  }
  return sum / norm;
}

/// Frequency of the mode sin(k x) of small velocities along `axis`, over four periods.
double frequency(Scene scene, double k, int axis, double drift, double expected)
{
  scene.bodies[0].velocity = {drift, 0, 0};
  scene.bodies[0].functions.velocity = [=](const Vector<3>& x) {
    const double v = 1e-3 * std::sin(k * x[0]);
    return axis == 0 ? Vector<3>(drift + v, 0, 0) : Vector<3>(drift, v, 0);
  };
  const auto simulation = Simulation::make(scene, 2);
  const auto start = particles_of(*simulation);
  const double end = 4.1 * 2 * pi / expected;
  std::vector<double> crossings;
  double before = 0, time_before = 0;
  while (simulation->time() < end) {
    simulation->advance(end);
    const double time = simulation->time() - 0.5 * simulation->last_step_size();
    const double now = mode(start, particles_of(*simulation), k, axis, axis == 0 ? drift : 0);
    if (before * now < 0) crossings.push_back(time_before + before / (before - now) * (time - time_before));
    before = now;
    time_before = time;
  }
  REQUIRE(crossings.size() == 8);
  return 7 * pi / (crossings.back() - crossings.front());
}

}  // namespace

TEST_CASE("waves in an endless bar run at the speed of sound, also while it drifts around its domain", "[slow]")
{
  const int axis = GENERATE(0, 1);
  const double speed = axis == 0 ? 10 : 10 / std::sqrt(3.0), k = 2 * pi / length;
  const int n_cells = is_rehearsal ? 24 : 48;
  Scene scene = endless_bar(n_cells);
  scene.n_patches = {2, 1, 1};
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  // Once around in a period.
  const double drift = GENERATE(0.0, 10.0);

  // Half a percent on 48 cells; errors are of second order.
  const double bar = 0.005 * std::pow(48.0 / n_cells, 2);
  CHECK(frequency(scene, k, axis, drift, k * speed) == Approx(k * speed).epsilon(bar));
}

TEST_CASE("a standing wave between mirrors is half of one around a periodic domain")
{
  const double k = 2 * pi / length;
  const Transfer transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  const auto make = [&](bool periodic, int n_cells, int n_patches) {
    Scene scene = endless_bar(64);
    scene.grid.n_cells[0] = n_cells;
    scene.n_patches = {n_patches, 1, 1};
    scene.transfer = transfer;
    scene.artificial_viscosity = components::ArtificialViscosity{};
    scene.grid.periodic = {periodic, periodic, false};
    add_walls(scene, 0);
    add_walls(scene, 1);
    // Walls count as edges in the bound on the step.
    scene.time.maximum_step = 0.005;
    // Strains up to 0.05.
    scene.bodies[0].functions.velocity = [k](const Vector<3>& x) { return Vector<3>(0.5 * std::sin(k * x[0]), 0, 0); };
    return Simulation::make(scene, 1);
  };
  const auto whole = make(true, 64, GENERATE(1, 4)), half = make(false, 32, 1);

  advance_to(*whole, 5);
  advance_to(*half, 5);

  REQUIRE(whole->n_steps() == half->n_steps());
  REQUIRE(whole->n_steps() >= 1000);
  const auto of_whole = travelled(*whole), of_half = particles_of(*half);
  double apart = 0, greatest = 0;
  std::size_t n = 0;
  for (const Particle& particle : of_whole) {
    if (particle.position[0] > length / 2) continue;
    const auto same = std::find_if(of_half.begin(), of_half.end(), [&](const Particle& other) {
      return (other.position - particle.position).norm() < 1e-6;
    });
    REQUIRE(same != of_half.end());
    ++n;
    apart =
        std::max({apart, (same->velocity - particle.velocity).norm(), std::abs(same->stress[0] - particle.stress[0])});
    greatest = std::max(greatest, std::abs(particle.stress[0]));
  }
  CHECK(n == of_half.size());
  CHECK(greatest > 1);
  CHECK(apart < 1e-9);
  CHECK(whole->report().kinetic == Approx(2 * half->report().kinetic).epsilon(1e-9));
}

}  // namespace test_periodic
