#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/tasks/scenes.hpp"

namespace test_transfers
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double h = 0.1;  // m
constexpr int n_cells = 8;

/// A transfer, and the part of a scene's wave that one step of it leaves, by the part lambda that PIC leaves.
struct Filter {
  std::string name;
  Transfer transfer;
  double flip_part;
  int order;

  double leaves(double lambda) const
  {
    if (transfer == "flip" || transfer == "tflip") return 1;
    if (transfer == "blend") return flip_part + (1 - flip_part) * lambda;
    if (transfer == "xpic" || transfer == "fmpm") return 1 - std::pow(1 - lambda, order);
    return lambda;
  }
};

void set(Scene& scene, const Filter& filter)
{
  scene.transfer = filter.transfer;
  scene.transfer_numbers.flip_part = filter.flip_part;
  scene.transfer_numbers.filter_order = filter.order;
}

const std::vector<Filter> filters{{"flip", Transfer("flip"), 0, 1},   {"tflip", Transfer("tflip"), 0, 1},
                                  {"pic", Transfer("pic"), 0, 1},     {"blend", Transfer("blend"), 0.7, 1},
                                  {"xpic 1", Transfer("xpic"), 0, 1}, {"xpic 2", Transfer("xpic"), 0, 2},
                                  {"xpic 5", Transfer("xpic"), 0, 5}, {"fmpm 1", Transfer("fmpm"), 0, 1},
                                  {"fmpm 2", Transfer("fmpm"), 0, 2}, {"fmpm 8", Transfer("fmpm"), 0, 8}};
/// Transfers that, like PIC, forget what the nodes do not hold, but bring gradients.
const std::vector<Filter> with_gradients{{"apic", Transfer("apic"), 0, 1}, {"tpic", Transfer("tpic"), 0, 1}};

/// The weight of a node for a particle `x` cells away, of two an axis in a full cell.
double weight(Interpolator interpolator, double x)
{
  x = std::abs(x);
  if (interpolator == Interpolator("gimp")) return std::max(0.0, 1 - x);
  if (x < 0.5) return 0.75 - x * x;
  return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}

/// A field of the nodes, cos(angle i), where a particle is, x in cells.
double wave_at(Interpolator interpolator, double angle, double x)
{
  double sum = 0;
  for (int i = static_cast<int>(std::floor(x)) - 1; i <= std::floor(x) + 2; ++i) {
    sum += weight(interpolator, x - i) * std::cos(angle * i);
  }
  return sum;
}

/// The part of that wave that particles bring to the node at 0.
double lambda(Interpolator interpolator, double angle)
{
  double sum = 0, weights = 0;
  for (const double x : {-1.25, -0.75, -0.25, 0.25, 0.75, 1.25}) {
    sum += weight(interpolator, x) * wave_at(interpolator, angle, x);
    weights += weight(interpolator, x);
  }
  return sum / weights;
}

/// Matter without forces that fills a periodic domain, and moves across x with `velocity`(x in cells). In all steps it
/// stays where it is.
template <class Velocity>
Scene full_of_matter(int dimension, const Filter& filter, Interpolator interpolator, Velocity velocity)
{
  Scene scene = empty_scene(dimension, {n_cells, 4, dimension == 3 ? 4 : 1}, h);
  scene.n_patches = {2, 1, 1};
  scene.grid.periodic = {true, true, dimension == 3};
  scene.time.maximum_step = 1e-9;
  scene.interpolator = interpolator;
  set(scene, filter);
  add_box(scene, add_elastic(scene, 1000, 1e-6, 0.3), {0, 0, 0}, {1, 1, 1}).functions.velocity =
      [velocity](const Vector<3>& x) { return Vector<3>(0, velocity(x[0] / h), 0); };
  return scene;
}

/// The part of the kinetic energy that is left after `n` steps.
double energy_left(const Scene& scene, int n)
{
  const auto simulation = Simulation::make(scene, 1);
  const double before = simulation->report().kinetic;
  for (int i = 0; i < n; ++i) simulation->advance(1e30);
  return simulation->report().kinetic / before;
}

}  // namespace

TEST_CASE("of a wave that the nodes can tell, each step leaves the part that theory says")
{
  const Filter filter = GENERATE(from_range(filters));
  const int dimension = GENERATE(2, 3), waves = GENERATE(1, 3);
  const Interpolator interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const double angle = 2 * std::numbers::pi * waves / n_cells;
  const Scene scene =
      full_of_matter(dimension, filter, interpolator, [=](double x) { return wave_at(interpolator, angle, x); });
  CAPTURE(filter.name, dimension, waves, interpolator);

  const double left = energy_left(scene, 3);

  CHECK(left == Approx(std::pow(filter.leaves(lambda(interpolator, angle)), 6)).epsilon(1e-6));
}

TEST_CASE("PIC with gradients keeps a wave between nodes as it is, from the first step on")
{
  const Filter filter = GENERATE(from_range(with_gradients));
  const int dimension = GENERATE(2, 3), n = GENERATE(1, 4);
  const double angle = 2 * std::numbers::pi / n_cells;
  const Scene scene = full_of_matter(dimension, filter, Interpolator("gimp"),
                                     [=](double x) { return wave_at(Interpolator("gimp"), angle, x); });

  // Between two nodes the weights of particles are linear, and they start with the gradients of their velocity.
  CHECK(energy_left(scene, n) == Approx(1).epsilon(1e-6));
}

TEST_CASE("noise that no node can tell stays with the particles that keep their velocities, and with no others")
{
  const Filter filter = GENERATE(from_range(filters), from_range(with_gradients));
  const Interpolator interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const Scene scene =
      full_of_matter(2, filter, interpolator, [](double x) { return std::sin(2 * std::numbers::pi * x); });
  CAPTURE(filter.name, interpolator);

  CHECK(energy_left(scene, 1) == Approx(std::pow(filter.leaves(0), 2)).margin(1e-12));
}

namespace
{

constexpr double spin = 10;  // rad/s

/// An elastic rod turns about z in free space, and bends as it starts to.
Scene turning_rod(int dimension, Transfer transfer, Interpolator interpolator)
{
  Scene scene = empty_scene(dimension, {12, 12, dimension == 3 ? 8 : 1}, h);
  scene.n_patches = {2, 1, 1};
  scene.transfer = transfer;
  scene.interpolator = interpolator;
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), {0.35, 0.5, 0.35}, {0.85, 0.65, 0.45}, {0.1, 0.2, 0})
      .angular_velocity = {0, 0, spin};
  return scene;
}

/// Angular momentum of the nodes about z, after contact and walls [kg m^2/s].
double angular_momentum_of_nodes(Simulation& simulation)
{
  const runtime::FieldCopy copy = simulation.fields({}, true);
  const runtime::NodeBlock& nodes = *copy.nodes;
  const auto numbers = [&](std::size_t column) {
    return std::get<std::span<const double>>(nodes.columns[column].values);
  };
  const auto density = numbers(0), velocity = numbers(1);
  const auto D = static_cast<std::size_t>(simulation.scene().grid.dimension);
  double sum = 0;
  std::size_t n = 0;
  for (const runtime::IndexBox& box : *nodes.boxes) {
    for_each(box, [&](const runtime::Index& i) {
      const double x = nodes.spacing * i[0], y = nodes.spacing * i[1];
      sum += density[n] * (x * velocity[D * n + 1] - y * velocity[D * n]);
      ++n;
    });
  }
  return sum * std::pow(nodes.spacing, static_cast<int>(D));
}

/// The greatest change of a free rod's angular momentum in a third of a turn, over its spin's.
double drift_of_angular_momentum(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 2);
  simulation->advance(1e30);
  const double start = angular_momentum_of_nodes(*simulation);
  double drift = 0;
  while (simulation->time() < 2 / spin) {
    simulation->advance(1e30);
    drift = std::max(drift, std::abs(angular_momentum_of_nodes(*simulation) - start));
  }
  const double mass = total_mass(simulation->report()), length = 0.5, width = 0.15;
  return drift / (mass * (length * length + width * width) / 12 * spin);
}

}  // namespace

TEST_CASE("APIC keeps the angular momentum of a free body to round-off, whatever the weights, and others do not")
{
  const int dimension = GENERATE(2, 3);
  const Interpolator interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto drift = [&](Transfer transfer) {
    return drift_of_angular_momentum(turning_rod(dimension, transfer, interpolator));
  };

  const double apic = drift(Transfer("apic")), tflip = drift(Transfer("tflip")), flip = drift(Transfer("flip"));

  CAPTURE(dimension, interpolator, apic, tflip, flip);
  CHECK(apic < 1e-11);
  CHECK(tflip > 1e-3);
  CHECK(flip > 0.3);
}

TEST_CASE("XPIC and FMPM of order 1 are PIC")
{
  Scene scene = empty_scene(2, {12, 12, 1}, h);
  const int soft = add_elastic(scene, 1000, 1e6, 0.3), hard = add_elastic(scene, 3000, 5e6, 0.2);
  scene.faces[0][0] = components::NoSlipWall();
  add_box(scene, soft, {0, 0.4, 0}, {0.4, 0.8, 0}, {2, 1, 0});
  add_box(scene, hard, {0.5, 0.3, 0}, {0.9, 0.6, 0});
  const auto end = [&](Transfer transfer) {
    scene.transfer = transfer;
    scene.transfer_numbers.filter_order = 1;
    const auto simulation = Simulation::make(scene, 1);
    for (int i = 0; i < 50; ++i) simulation->advance(1e30);
    return particles_of(*simulation);
  };

  const auto pic = end(Transfer("pic"));

  for (const Transfer transfer : {Transfer("xpic"), Transfer("fmpm")}) {
    const auto other = end(transfer);
    for (std::size_t p = 0; p < pic.size(); ++p) {
      REQUIRE((other[p].velocity - pic[p].velocity).norm() < 1e-13);
      REQUIRE((other[p].position - pic[p].position).norm() < 1e-14);
    }
  }
}

}  // namespace test_transfers
