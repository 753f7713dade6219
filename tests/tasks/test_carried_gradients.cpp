#include <catch2/catch.hpp>

#include "tests/tasks/scenes.hpp"

namespace test_carried_gradients
{

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

TEST_CASE("a thin body turns as fast as it spins where velocities come to the grid with their gradient", "[pinned]")
{
  const int dimension = GENERATE(2, 3);

  const double plain = lag(spinning_rod(dimension, Transfer("flip")));
  const double tflip = lag(spinning_rod(dimension, Transfer("tflip")));
  const double apic = lag(spinning_rod(dimension, Transfer("apic")));
  const double tpic = lag(spinning_rod(dimension, Transfer("tpic")));

  CAPTURE(dimension, plain, tflip, apic, tpic);
  // Pinned from results/verification/angular_momentum.csv: how much plain FLIP loses no theory says.
  CHECK(plain == Approx(0.35).margin(0.02));
  CHECK(std::abs(tflip) < 2e-3);
  CHECK(std::abs(apic) < 2e-3);
  CHECK(std::abs(tpic) < 2e-3);
}

// Without gradients a node at a surface has the mean velocity of the matter that it reaches; PIC hands that to the
// particles in every step.
TEST_CASE("a thin body loses its spin the more, the more of it the nodes filter", "[pinned]")
{
  const auto lag_of = [](Transfer transfer, int order) {
    Scene scene = spinning_rod(2, transfer);
    scene.transfer_numbers.filter_order = order;
    return lag(scene);
  };

  const double pic = lag_of(Transfer("pic"), 1), xpic = lag_of(Transfer("xpic"), 5), fmpm = lag_of(Transfer("fmpm"), 5);
  const double plain = lag_of(Transfer("flip"), 1), blend = lag_of(Transfer("blend"), 1);

  CAPTURE(pic, xpic, fmpm, plain, blend);
  // Pinned from results/verification/angular_momentum.csv. What each transfer filters out of a wave is held against
  // theory in test_transfers.cpp.
  CHECK(pic == Approx(0.98).margin(0.01));
  CHECK(xpic == Approx(0.94).margin(0.01));
  CHECK(fmpm == Approx(0.86).margin(0.01));
  CHECK(blend == Approx(0.56).margin(0.02));
  CHECK(plain == Approx(0.35).margin(0.02));
}

namespace
{

/// Two turning blocks that are mirror images of each other meet at x = 0.8 m, or one of them meets a mirror at x = 0.
Scene meeting_blocks(bool whole, Transfer transfer)
{
  Scene scene = empty_scene(2, {whole ? 16 : 8, 12, 1}, 0.1);
  scene.transfer = transfer;
  scene.transfer_numbers.filter_order = 3;
  scene.time.maximum_step = 1e-4;
  const double mirror = whole ? 0.8 : 0;
  const int soft = add_elastic(scene, 1000, 1e6, 0.3);
  add_box(scene, soft, {mirror + 0.1, 0.4, 0}, {mirror + 0.5, 0.7, 0}, {-4, 1, 0}).angular_velocity = {0, 0, 5};
  if (whole) {
    add_box(scene, soft, {mirror - 0.5, 0.4, 0}, {mirror - 0.1, 0.7, 0}, {4, 1, 0}).angular_velocity = {0, 0, -5};
  } else {
    scene.faces[0] = {components::SymmetryFace(), components::OpenFace()};
  }
  return scene;
}

}  // namespace

TEST_CASE("with any transfer a body meets a mirror as it meets its image")
{
  const Transfer transfer = GENERATE(Transfer("pic"), Transfer("blend"), Transfer("tflip"), Transfer("apic"),
                                     Transfer("tpic"), Transfer("xpic"), Transfer("fmpm"));
  const auto whole = Simulation::make(meeting_blocks(true, transfer), 1);
  const auto half = Simulation::make(meeting_blocks(false, transfer), 1);
  const double start = whole->report().momentum()[1];

  advance_to(*whole, 0.06);
  advance_to(*half, 0.06);

  const auto at_image = particles_of(*whole), at_mirror = particles_of(*half);
  Eigen::Vector3d velocities = Eigen::Vector3d::Zero();
  for (std::size_t p = 0; p < at_mirror.size(); ++p) {
    velocities += at_mirror[p].velocity;
    REQUIRE((at_image[p].position - Eigen::Vector3d(0.8, 0, 0) - at_mirror[p].position).norm() < 1e-10);
    REQUIRE((at_image[p].velocity - at_mirror[p].velocity).norm() < 1e-8);
  }
  // It has bounced off.
  CHECK(velocities[0] > 0);
  CHECK(whole->report().momentum()[1] == Approx(start).epsilon(1e-12));
}

}  // namespace test_carried_gradients
