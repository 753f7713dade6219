#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tasks/method.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_pressure_load
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double E = 1e6, nu = 0.25, density = 1000, pressure = 1200;

/// Constant, on all of a body.
BodyPressure everywhere(double p)
{
  return {components::PressureCurve({{0, p}})};
}

/// Constant, on what starts within a box.
BodyPressure within(double p, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper)
{
  return {components::PressureCurve({{0, p}}), {lower, upper}};
}

/// An elastic column between smooth walls on a floor, 1 m high, its top pressed; 1 m is 10 cells.
Scene pressed_column(double damping, Interpolator interpolator)
{
  Scene scene = empty_scene(2, {4, 16, 1}, 0.1);
  scene.n_patches = {1, 4, 1};
  scene.interpolator = interpolator;
  add_walls(scene, 0);
  scene.faces[1][0] = components::SymmetryFace();
  scene.local_damping = damping;
  add_box(scene, add_elastic(scene, density, E, nu), {0, 0, 0}, {0.4, 1, 0}).pressure = everywhere(pressure);
  return scene;
}

double period_of_column()
{
  return 4 / std::sqrt(uniaxial_modulus(E, nu) / density);
}

/// A free block of 0.6 x 0.5 in the middle of an open grid.
Scene free_block(const BodyPressure& load)
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  add_box(scene, add_elastic(scene, density, E, nu), {0.3, 0.3, 0}, {0.9, 0.8, 0}).pressure = load;
  return scene;
}

/// Force of the load on the undeformed body.
Eigen::Vector3d first_force(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 1);
  simulation->advance(1);
  return simulation->take_mean_forces().loads.at(0);
}

}  // namespace

TEST_CASE("a damped disk under pressure from all sides comes to that pressure inside")
{
  Scene scene = empty_scene(2, {14, 14, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  scene.local_damping = 0.3;
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  add_disk(scene, add_elastic(scene, density, E, nu), 0.71, 0.68, 0.45, {0, 0, 0}).pressure = everywhere(pressure);
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 1);

  double error = 0, across = 0;
  for (const Particle& p : particles_of(*simulation)) {
    error =
        std::max({error, std::abs(p.stress[0] + pressure), std::abs(p.stress[1] + pressure), std::abs(p.stress[3])});
    across = std::max(across, std::abs(p.stress[2] + 2 * nu * pressure));
  }
  CAPTURE(error / pressure, across / pressure);
  CHECK(error < 0.01 * pressure);
  CHECK(across < 0.01 * pressure);
}

TEST_CASE("a quarter of a disk between mirrors is pressed as the whole is, and not where the mirrors are")
{
  Scene scene = empty_scene(2, {8, 8, 1}, 0.1);
  scene.faces[0][0] = scene.faces[1][0] = components::SymmetryFace();
  scene.local_damping = 0.3;
  // The part of it in the grid.
  add_disk(scene, add_elastic(scene, density, E, nu), 0, 0, 0.5, {0, 0, 0}).pressure = everywhere(pressure);
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 1);

  double error = 0;
  for (const Particle& p : particles_of(*simulation)) {
    error = std::max({error, std::abs(p.stress[0] + pressure), std::abs(p.stress[1] + pressure)});
  }
  CAPTURE(error / pressure);
  CHECK(error < 0.01 * pressure);
  const Eigen::Vector3d force = simulation->take_mean_forces().loads.at(0);
  CHECK(force.x() == Approx(-pressure * 0.5).epsilon(0.03));
  CHECK(force.y() == Approx(-pressure * 0.5).epsilon(0.03));
}

TEST_CASE("a column under pressure bears it in every layer, and is shortened by p H / M")
{
  const auto interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto simulation = Simulation::make(pressed_column(0.3, interpolator), 1);
  const auto at_start = particles_of(*simulation);

  advance_to(*simulation, 9 * period_of_column());
  simulation->take_mean_forces();
  advance_to(*simulation, 10 * period_of_column());

  const auto now = particles_of(*simulation);
  double stress_error = 0, settlement_error = 0;
  const double strain = pressure / uniaxial_modulus(E, nu);
  for (std::size_t p = 0; p < now.size(); ++p) {
    stress_error = std::max(stress_error, std::abs(now[p].stress[1] + pressure) / pressure);
    const double moved = at_start[p].position.y() - now[p].position.y();
    settlement_error = std::max(settlement_error, std::abs(moved - strain * at_start[p].position.y()) / strain);
  }
  CAPTURE(stress_error, settlement_error);
  CHECK(stress_error < 0.01);
  CHECK(settlement_error < 0.01);
  const Eigen::Vector3d force = simulation->take_mean_forces().loads.at(0);
  CHECK(force.y() == Approx(-pressure * 0.4).epsilon(0.005));
  CHECK(std::abs(force.x()) < 1e-9 * pressure);
}

TEST_CASE("the work of a load is p A u")
{
  const double damping = GENERATE(0.0, 0.3);
  const auto simulation = Simulation::make(pressed_column(damping, Interpolator("gimp")), 1);
  const auto top = [&] {
    double y = 0;
    for (const Particle& p : particles_of(*simulation)) y = std::max(y, p.position.y());
    return y;
  };
  const double at_start = top();

  advance_to(*simulation, 0.5 * period_of_column());

  const double strain_above = pressure / uniaxial_modulus(E, nu) * (1 - at_start);
  CHECK(simulation->energies().driving == Approx(pressure * 0.4 * (at_start - top() + strain_above)).epsilon(0.01));
}

TEST_CASE("the work of a load that grows is what the body stores, moves with and loses")
{
  Scene scene = pressed_column(GENERATE(0.0, 0.3), GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline")));
  scene.bodies[0].pressure->curve = components::PressureCurve({{0, 0}, {period_of_column(), pressure}});
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 2 * period_of_column());

  const double work = simulation->energies().driving;
  const double strain = pressure / uniaxial_modulus(E, nu);
  // A load that grows over just a period leaves no swing, so that half of p A u is stored and nothing else is left.
  if (scene.local_damping == 0) CHECK(work == Approx(0.5 * pressure * 0.4 * strain).epsilon(0.02));
  CHECK(simulation->report().kinetic + worked(simulation->energies()) == Approx(work).epsilon(0.01));
}

TEST_CASE("a flat side is pressed with p times its length, and the part of it in a box with that of the part")
{
  constexpr double top = 0.8;
  CHECK(first_force(free_block(everywhere(pressure))).norm() < 1e-9 * pressure);
  const auto on = [&](const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
    return Eigen::Vector3d(first_force(free_block(within(pressure, lower, upper))) / pressure);
  };
  // However deep the box reaches beneath the top.
  for (const double depth : {0.001, 0.05, 0.3}) {
    CAPTURE(depth);
    CHECK(on({0.2, top - depth, 0}, {1, 1, 0}).isApprox(Eigen::Vector3d(0, -0.6, 0), 1e-9));
    CHECK(on({0.4, top - depth, 0}, {0.63, 1, 0}).isApprox(Eigen::Vector3d(0, -0.23, 0), 1e-9));
  }
  CHECK(on({0.2, 0.2, 0}, {0.301, 1, 0}).isApprox(Eigen::Vector3d(0.5, 0, 0), 1e-9));
}

TEST_CASE("a cube in space is pressed with p times the area of its side, by either interpolator")
{
  Scene scene = empty_scene(3, {8, 8, 8}, 0.1);
  scene.n_patches = {2, 1, 2};
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  add_box(scene, add_elastic(scene, density, E, nu), {0.2, 0.2, 0.2}, {0.6, 0.5, 0.6}).pressure =
      within(pressure, {0, 0, 0.59}, {0.8, 0.8, 0.8});

  CHECK(first_force(scene).isApprox(Eigen::Vector3d(0, 0, -pressure * 0.4 * 0.3), 1e-9));
}

TEST_CASE("where two bodies of one material touch there is no surface to be pressed")
{
  Scene scene = empty_scene(2, {14, 10, 1}, 0.1);
  const int elastic = add_elastic(scene, density, E, nu);
  add_box(scene, elastic, {0.3, 0.3, 0}, {0.7, 0.7, 0}).pressure = everywhere(pressure);
  add_box(scene, elastic, {0.7, 0.3, 0}, {1.1, 0.7, 0});

  CHECK(first_force(scene).isApprox(Eigen::Vector3d(pressure * 0.4, 0, 0), 1e-9));
}

TEST_CASE("a block pressed on one side by a load that comes and goes has the momentum of its integral")
{
  BodyPressure load = within(0, {0.2, 0.79, 0}, {1, 1, 0});
  load.curve = components::PressureCurve({{0.01, 0}, {0.03, pressure}, {0.04, pressure}, {0.06, 0}});
  const auto simulation = Simulation::make(free_block(load), 1);

  advance_to(*simulation, 0.08);

  const double given = pressure * 0.6 * 0.03;
  const Eigen::Vector3d momentum = simulation->report().momentum();
  CHECK(momentum.y() == Approx(-given).epsilon(0.005));
  CHECK(std::abs(momentum.x()) < 1e-9 * given);
  CHECK(simulation->grid_totals().impulse[1] == Approx(momentum.y()).epsilon(1e-9));
  const double pressed_for = 0.08 - 0.5 * simulation->last_step_size();
  CHECK(simulation->take_mean_forces().loads.at(0).y() * pressed_for == Approx(momentum.y()).epsilon(1e-9));
  const double work = simulation->energies().driving;
  CHECK(simulation->report().kinetic + worked(simulation->energies()) == Approx(work).epsilon(0.01));
}

namespace
{

/// Weightless soil that flows as it yields, with a strip on top: the right half of it.
Scene strip_on_soil(double load)
{
  // Mohr and Coulomb's, in plane strain.
  constexpr double friction = 20 * std::numbers::pi / 180, cohesion = 10e3;
  // The cone that has this strength in plane strain with associated flow, and its angles in triaxial compression
  // (D. C. Drucker, W. Prager, Q. Appl. Math. 10, 1952).
  const double t = std::tan(friction), root = std::sqrt(9 + 12 * t * t), cone = std::sqrt(3.0) * t / root;
  const double s = 3 * cone / (2 + cone), triaxial = std::asin(s);
  const double own_cohesion = 3 * cohesion / root * std::sqrt(3.0) * (3 - s) / (6 * std::cos(triaxial));
  const double degrees = triaxial * 180 / std::numbers::pi;
  // L. Prandtl, 1920.
  const double N =
      (std::exp(std::numbers::pi * t) * std::pow(std::tan(std::numbers::pi / 4 + friction / 2), 2) - 1) / t;

  Scene scene = empty_scene(2, {32, 14, 1}, 0.125);
  scene.n_patches = {2, 2, 1};
  scene.faces[0] = {components::SymmetryFace(), components::SymmetryFace()};
  scene.faces[1][0] = components::NoSlipWall();
  scene.local_damping = 0.3;
  scene.materials.push_back({"soil", 1600,
                             components::DruckerPrager{.bulk_modulus = 20e6,
                                                       .shear_modulus = 12e6,
                                                       .friction_angle = degrees,
                                                       .dilation_angle = degrees,
                                                       .cohesion = own_cohesion}});
  SceneBody& soil = add_box(scene, 0, {0, 0, 0}, {4, 1.5, 0});
  soil.pressure = within(0, {-1, 1.49, 0}, {0.5, 2, 0});
  soil.pressure->curve = components::PressureCurve({{0, 0}, {0.1, load * N * cohesion}});
  return scene;
}

/// How fast the soil beneath the middle of the strip goes down [m/s], over the time after the load has come.
double settling(double load)
{
  const auto simulation = Simulation::make(strip_on_soil(load), 2);
  const auto depth = [&] {
    const auto particles = particles_of(*simulation);
    return 1.5 - std::max_element(particles.begin(), particles.end(), [](const Particle& a, const Particle& b) {
                   const auto at_middle = [](const Particle& p) { return p.position.x() < 0.1 ? p.position.y() : 0; };
                   return at_middle(a) < at_middle(b);
                 })->position.y();
  };
  advance_to(*simulation, 0.2);
  const double before = depth();
  advance_to(*simulation, 0.3);
  return (depth() - before) / 0.1;
}

}  // namespace

TEST_CASE("a strip on soil stands at Prandtl's load and sinks in 5 % above it")
{
  CHECK(std::abs(settling(1.0)) < 1e-3);
  CHECK(settling(1.05) > 0.01);
}

TEST_CASE("the force of a load is its pressure times the surface also beneath another body, near or touching")
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  add_walls(scene, 0);
  scene.faces[1][0] = components::SymmetryFace();
  add_box(scene, add_elastic(scene, density, E, nu), {0, 0, 0}, {1.2, 0.5, 0}).pressure = everywhere(pressure);
  const double top = 0.5 + GENERATE(0.0, 0.05);
  add_box(scene, add_elastic(scene, density, E, nu), {0.3, top, 0}, {0.9, top + 0.2, 0});
  scene.contacts.push_back({0, 1, 0, components::RegressionNormal()});

  const Eigen::Vector3d force = first_force(scene);

  CHECK(force[1] == Approx(-pressure * 1.2).epsilon(1e-12));
}

TEST_CASE("the surface of a pressed material is known, also where another's gives the normal of their contact")
{
  Scene scene = free_block(everywhere(pressure));
  add_box(scene, add_elastic(scene, density, E, nu), {0.3, 0.1, 0}, {0.9, 0.3, 0});
  const int of_other = 1;
  scene.contacts.push_back({0, 1, 0.3, components::OwnNormal{of_other}});
  const bool pressed = GENERATE(true, false);
  if (!pressed) scene.bodies[0].pressure.reset();

  const Method<2> method(scene);

  CHECK(method.needs_surface_of(0) == pressed);
  CHECK(method.needs_surface_of(of_other));
}

}  // namespace test_pressure_load
