#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_energy_filter
{

/// Energy that particles filter out of the motion of the nodes: with it the balance closes.
using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double cell = 0.1;

/// A soft ball that spins while another hits it, in free space without viscosity.
Scene spinning_balls(int dimension)
{
  Scene scene = empty_scene(dimension, {16, 12, dimension == 3 ? 10 : 1}, cell);
  scene.n_patches = {2, 2, 1};
  scene.interpolator = Interpolator("quadratic_spline");
  const int soft = add_elastic(scene, 1000, 1e5, 0.3);
  const auto add = [&](const Triple& centre, const Triple& velocity) -> SceneBody& {
    if (dimension == 2) return add_disk(scene, soft, centre[0], centre[1], 0.25, velocity);
    const components::Ball<3> ball{{centre[0], centre[1], centre[2]}, 0.25};
    return add_body(scene, soft, components::Solid<3>(ball), velocity);
  };
  add({0.5, 0.62, 0.5}, {2, 0, 0}).angular_velocity = {0, 0, 6};
  add({1.02, 0.55, 0.5}, {-1, 0.3, 0});
  return scene;
}

/// The quadratic B-spline of a node and its slope along one axis, `r` cells from it.
double spline(double r)
{
  const double a = std::abs(r);
  return a < 0.5 ? 0.75 - r * r : (a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0);
}
double slope(double r)
{
  const double a = std::abs(r);
  return a < 0.5 ? -2 * r : (a < 1.5 ? -std::copysign(1.5 - a, r) : 0);
}

using Node = std::array<int, 3>;
struct Reach {
  Node node;
  double weight;
  Eigen::Vector3d gradient;
};

/// The nodes that a particle reaches; in the plane those of one layer.
std::vector<Reach> reach_of(const Eigen::Vector3d& x, int dimension)
{
  std::vector<Reach> all;
  Node first{};
  for (int k = 0; k < dimension; ++k)
    first[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(x[k] / cell)) - 1;
  for (int n = 0; n < (dimension == 2 ? 9 : 27); ++n) {
    Reach r{{first[0] + n % 3, first[1] + n / 3 % 3, first[2] + n / 9}, 1, Eigen::Vector3d::Zero()};
    for (int k = 0; k < dimension; ++k) r.weight *= spline(x[k] / cell - r.node[static_cast<std::size_t>(k)]);
    for (int k = 0; k < dimension; ++k) {
      const double away = x[k] / cell - r.node[static_cast<std::size_t>(k)];
      r.gradient[k] = slope(away) / cell;
      for (int j = 0; j < dimension; ++j) {
        if (j != k) r.gradient[k] *= spline(x[j] / cell - r.node[static_cast<std::size_t>(j)]);
      }
    }
    all.push_back(r);
  }
  return all;
}

Eigen::Matrix3d stress_of(const Particle& p)
{
  const auto& s = p.stress;
  return (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
}

/// A step of all particles by plain loops, from their state before it and the sizes of the step and that before it;
/// `after` is their state after it, of which stress and volume are taken.
struct PlainStep {
  double filtered_at_nodes = 0, filtered_at_particles = 0, stress_work_at_start = 0, stress_work_at_end = 0;

  PlainStep(const std::vector<Particle>& before, const std::vector<Particle>& after, int dimension, double size,
            double size_before)
  {
    struct Sums {
      double mass = 0;
      Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), force = Eigen::Vector3d::Zero();
      Eigen::Vector3d start() const { return momentum / mass; }
    };
    const double full = std::pow(cell / 2, dimension);
    std::map<Node, Sums> nodes;
    for (const Particle& p : before) {
      const double mass = p.density * p.volume_ratio * full;
      for (const Reach& r : reach_of(p.position, dimension)) {
        nodes[r.node].mass += mass * r.weight;
        nodes[r.node].momentum += mass * r.weight * p.velocity;
        nodes[r.node].force -= p.volume_ratio * full * stress_of(p) * r.gradient;
      }
    }
    const double kick = 0.5 * (size_before + size);
    for (const auto& [i, node] : nodes) {
      if (node.mass < 1e-20) continue;
      filtered_at_nodes += 0.5 * (kick * node.force).squaredNorm() / node.mass;
      stress_work_at_start -= 0.5 * size_before * node.force.dot(node.start());
    }
    for (std::size_t n = 0; n < before.size(); ++n) {
      const Particle& p = before[n];
      Eigen::Vector3d change = Eigen::Vector3d::Zero();
      Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
      for (const Reach& r : reach_of(p.position, dimension)) {
        const Sums& node = nodes[r.node];
        if (node.mass < 1e-20) continue;
        const Eigen::Vector3d by_force = kick * node.force / node.mass;
        change += r.weight * by_force;
        f += size * (node.start() + by_force) * r.gradient.transpose();
      }
      filtered_at_particles += 0.5 * p.density * p.volume_ratio * full * change.squaredNorm();
      const Eigen::Matrix3d strain = Eigen::Matrix3d::Identity() - f.inverse();
      stress_work_at_end += 0.5 * after[n].volume_ratio * full * (stress_of(after[n]).transpose() * strain).trace();
    }
  }
};

}  // namespace

TEST_CASE("what particles filter out of a FLIP step is the energy of the nodes' changes less that of their own")
{
  const int dimension = GENERATE(2, 3);
  Scene scene = spinning_balls(dimension);
  scene.time.multiplier = 0.5;
  const auto simulation = Simulation::make(scene, 2);
  for (int n = 0; n < 50; ++n) simulation->advance(1e30);
  // The step that is compared is a short one, and so is the one before.
  const double short_step = simulation->last_step_size() / 25;
  simulation->advance(simulation->time() + short_step);
  const auto before = particles_of(*simulation);
  const double size_before = simulation->last_step_size();
  const GridTotals nodes_before = simulation->grid_totals();

  simulation->advance(simulation->time() + short_step);

  const PlainStep plain(before, particles_of(*simulation), dimension, simulation->last_step_size(), size_before);
  const GridTotals& nodes = simulation->grid_totals();
  const double nodes_gain = nodes.gained_by_nodes - nodes_before.gained_by_nodes,
               particles_gain = nodes.gained_by_particles - nodes_before.gained_by_particles,
               stress_work_at_start = nodes.taken_by_forces - nodes_before.taken_by_forces,
               stress_work_at_end = simulation->energies().half_step;
  CHECK(plain.filtered_at_nodes > 1.2 * plain.filtered_at_particles);
  CHECK(nodes_gain - particles_gain == Approx(plain.filtered_at_nodes - plain.filtered_at_particles).epsilon(1e-8));
  CHECK(stress_work_at_start == Approx(plain.stress_work_at_start).epsilon(1e-8));
  // The strain increment is that of the gradient but for its square: the step is short.
  CHECK(stress_work_at_end == Approx(plain.stress_work_at_end).epsilon(1e-3));
}

namespace
{

/// All energy with what was filtered out, but what outside worked, as of the middle of the last step, where velocities
/// are: `before` are the energies before that step.
double balance(Simulation& simulation, const EnergyLedger& before)
{
  const EnergyLedger& now = simulation.energies();
  // Damping is a part of the kick: no half of it is ahead.
  const double viscous = simulation.scene().local_damping > 0 ? 0 : now.viscous - before.viscous;
  const double ahead = 0.5 * (now.elastic + now.plastic + viscous - before.elastic - before.plastic);
  const ParticleReport report = simulation.report();
  return report.kinetic + worked(now) + now.filter - ahead - now.driving;
}

struct Closing {
  double filtered;  ///< J
  double error;     ///< J, the largest at any step
};

/// Runs a scene on which no gravity acts, in short steps: the strain of a step has an error of its own. The bars on
/// what is left of the balance are pinned just above what it gave; that a step filters out what it should is held
/// against plain loops above.
Closing closing(Scene scene, double end)
{
  scene.time.multiplier = 0.1;
  const auto simulation = Simulation::make(scene, 2);
  const double at_start = simulation->report().kinetic + simulation->energies().elastic;
  Closing seen{};
  while (simulation->time() < end) {
    const EnergyLedger before = simulation->energies();
    simulation->advance(end);
    seen.error = std::max(seen.error, std::abs(balance(*simulation, before) - at_start));
  }
  REQUIRE(simulation->lost().count == 0);
  seen.filtered = simulation->energies().filter;
  return seen;
}

double kinetic_at_start(const Scene& scene)
{
  return Simulation::make(scene, 1)->report().kinetic;
}

/// A punch of steel goes into sand between mirrors.
Scene punch(int dimension)
{
  constexpr double h = 0.02;
  Scene scene = empty_scene(dimension, {12, 12, dimension == 3 ? 4 : 1}, h);
  scene.n_patches = {3, 2, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) add_walls(scene, axis);
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.materials.push_back({"sand", 1624, concrete_sand::sand(components::ElasticUpdate::state)});
  const int steel = add_elastic(scene, 7800, 2e10, 0.3);
  add_box(scene, 0, {0, 0, 0}, {1, 0.14, 1});
  add_box(scene, steel, {0, 0.15, 0}, {0.06, 0.21, 1}, {0, -100, 0});
  scene.contacts.push_back({0, steel, 0.3});
  return scene;
}

/// A block flies against a rough floor.
Scene thrown_block()
{
  Scene scene = empty_scene(2, {40, 10, 1}, 0.025);
  scene.faces[1][0] = components::RoughWall{0.3};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  add_box(scene, add_elastic(scene, 2000, 1e7, 0.2), {0.1, 0, 0}, {0.5, 0.1, 0}, {0, -1, 0});
  return scene;
}

}  // namespace

TEST_CASE("with what particles filter out the energy of balls that meet and spin is all there", "[pinned]")
{
  Scene scene = spinning_balls(GENERATE(2, 3));
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const double given = kinetic_at_start(scene);

  const Closing seen = closing(scene, 0.05);

  CAPTURE(seen.filtered / given, seen.error / given);
  CHECK(seen.error < 4e-4 * given);
}

TEST_CASE("with what particles filter out the energy of a punch in sand is all there", "[slow][pinned]")
{
  Scene scene = punch(GENERATE(2, 3));
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  const double given = kinetic_at_start(scene);

  const Closing seen = closing(scene, end_of(5e-4));

  CAPTURE(seen.filtered / given, seen.error / given);
  if (is_rehearsal) return;
  CHECK(std::abs(seen.filtered) > 0.001 * given);
  CHECK(seen.error < 0.06 * std::abs(seen.filtered));
}

TEST_CASE("what a block that is thrown at a rough wall loses is filtered out or taken by the wall", "[pinned]")
{
  const Scene scene = thrown_block();
  const double given = kinetic_at_start(scene);

  const Closing seen = closing(scene, 0.03);

  CAPTURE(seen.filtered / given, seen.error / given);
  CHECK(seen.filtered > 0.1 * given);
  CHECK(seen.error < 0.02 * std::abs(seen.filtered));
}

TEST_CASE("an elastic block that is pressed onto a damped one has its energy", "[pinned]")
{
  Scene scene = empty_scene(2, {16, 20, 1}, 0.05);
  add_walls(scene, 1);
  scene.local_damping = 0.3;
  const int lower = add_elastic(scene, 1000, 1e6, 0.25), upper = add_elastic(scene, 2000, 4e6, 0.25);
  add_box(scene, lower, {0.2, 0, 0}, {0.6, 0.4, 0});
  add_box(scene, upper, {0.3, 0.4, 0}, {0.5, 0.6, 0}, {0, -2, 0});
  scene.contacts.push_back({lower, upper, 0.3});
  const double given = kinetic_at_start(scene);

  const Closing seen = closing(scene, 0.05);

  CAPTURE(seen.filtered / given, seen.error / given);
  CHECK(seen.error < 0.005 * std::abs(seen.filtered));
}

TEST_CASE("what is filtered out is the same, bit by bit, on any ranks and threads", "[ranks]")
{
  Scene scene = punch(2);
  const auto filtered = [](Simulation& simulation) {
    for (int n = 0; n < 40; ++n) simulation.advance(1e30);
    return simulation.energies().filter;
  };
  const auto alone = Simulation::make(scene, 1);
  const double expected = filtered(*alone);

  for (const int n_threads : {1, 2}) {
    const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                                             runtime::Communicator::world());
    CHECK(filtered(*simulation) == expected);
  }
  CHECK(expected != 0);
}

}  // namespace test_energy_filter
