#include <catch2/catch.hpp>

#include "tests/tasks/scenes.hpp"

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double spin = 10;  // rad/s

/// A stiff rod, 5 cells long and 1 thick, spins about z in free space.
Scene spinning_rod(int dimension, Transfer transfer)
{
  constexpr double h = 0.1;
  Scene scene = empty_scene(dimension, {12, 12, dimension == 3 ? 8 : 1}, h);
  scene.n_patches = {2, 1, 1};
  scene.transfer = transfer;
  const int steel = add_elastic(scene, 1000, 1e7, 0.3);
  add_box(scene, steel, {0.35, 0.55, 0.35}, {0.85, 0.65, 0.45}).angular_velocity = {0, 0, spin};
  return scene;
}

/// Angle about z by which the particles have turned about their middle [rad].
double turned(const std::vector<Particle>& start, const std::vector<Particle>& now)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), middle_now = Eigen::Vector3d::Zero();
  for (std::size_t p = 0; p < now.size(); ++p) {
    middle += start[p].position / static_cast<double>(now.size());
    middle_now += now[p].position / static_cast<double>(now.size());
  }
  double sine = 0, cosine = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const Eigen::Vector3d before = start[p].position - middle, after = now[p].position - middle_now;
    sine += before[0] * after[1] - before[1] * after[0];
    cosine += before[0] * after[0] + before[1] * after[1];
  }
  return std::atan2(sine, cosine);
}

/// By which part it has turned less than it should, after about a radian.
double lag(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 2);
  const auto start = particles_of(*simulation);
  advance_to(*simulation, 1 / spin);
  return 1 - turned(start, particles_of(*simulation));
}

}  // namespace

TEST_CASE("a thin body turns as fast as it spins where velocities come to the grid with their gradient")
{
  const int dimension = GENERATE(2, 3);

  const double plain = lag(spinning_rod(dimension, Transfer::flip));
  const double affine = lag(spinning_rod(dimension, Transfer::affine));

  CAPTURE(dimension, plain, affine);
  CHECK(plain > 0.05);
  CHECK(std::abs(affine) < 2e-3);
}
