#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

#include "components/loads/time_step.hpp"

namespace test_time_step
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// Cells of 0.01 m; waves of 10 m/s, as density is 1 and there is no shear.
template <int D>
double step_of(double own_stiffness, const ArtificialViscosity& viscosity, double volume_rate = 0,
               const Vector<D>& velocity = Vector<D>::Zero())
{
  return viscous_time_step<D>(0.01, {1, 100, 0, velocity, volume_rate, own_stiffness}, viscosity);
}

/// Whether a mode of the grid stays bounded of which the nodes give nothing back to the particles: in each step nodes
/// start anew from what particles kept, which is nothing, and are kicked by the strain and by their motion before.
bool stays_bounded(double a, double b, double dt)
{
  double displacement = 1, velocity = 0;
  for (int i = 0; i < 20000; ++i) {
    velocity = dt * (-a * displacement - b * velocity);
    displacement += dt * velocity;
    if (!(std::abs(displacement) < 1e6)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the published time step is the least over the axes of cell size over signal speed")
{
  CHECK(published_time_step<2>(0.01, 400, {100, -50}) == Approx(0.01 / 500));
  CHECK(published_time_step<3>(0.01, 400, {0, 0, -600}) == Approx(0.01 / 1000));
}

TEST_CASE("without viscosity the viscous time step is that of waves and of the particle's own stiffness")
{
  const ArtificialViscosity none{0, 0};

  // a h^2 = (4.5 + 3.5) 10^2, and h / dt = sqrt(a h^2 / 2).
  CHECK(step_of<2>(3.5, none) == Approx(0.01 / 20));
  CHECK(step_of<2>(3.5, none, -1000, {60, -80}) == Approx(0.01 / 120));
  // Nodes that move four times as far.
  CHECK(viscous_time_step<2>(0.01, {1, 100, 0, {0, 0}, 0, 3.5}, none, 4) == Approx(0.01 / 40));
}

TEST_CASE("a particle's own stiffness acts with the modulus of equal strain along all axes")
{
  const ArtificialViscosity none{0, 0};
  constexpr double K = 3, G = 9;
  // Strain e along all axes: the stress over e is K D + 2 G (1 - D / 3), and D axes share it.
  const auto step = [&](auto particle, double modulus) {
    return 0.01 / std::sqrt(0.5 * (shared_stiffness * (K + 4 * G / 3) + particle.own_stiffness * modulus));
  };
  const StiffParticle<2> in_plane{1, K, G, {0, 0}, 0, 10};
  const StiffParticle<3> in_space{1, K, G, {0, 0, 0}, 0, 10};

  CHECK(viscous_time_step<2>(0.01, in_plane, none) == Approx(step(in_plane, (2 * K + 2 * G / 3) / 2)));
  CHECK(viscous_time_step<3>(0.01, in_space, none) == Approx(step(in_space, 3 * K / 3)));
}

TEST_CASE("viscosity shortens the time step, by its quadratic part only in compression")
{
  const ArtificialViscosity viscosity{0.2, 2};

  // b h = (4.5 + 0.5) (0.2 * 10 + 2 * 3) = 40, a h^2 = 500.
  CHECK(step_of<3>(0.5, viscosity, -300) == Approx(0.01 / (20 + std::sqrt(400 + 250))));
  CHECK(step_of<3>(0.5, viscosity, 300) == Approx(0.01 / (5 + std::sqrt(25 + 250))));
}

TEST_CASE("the viscous time step is the limit of stability of a mode that particles do not keep, with lagged damping")
{
  constexpr double h = 0.01, c = 10, own_stiffness = 2.5;

  for (const double linear : {0.0, 0.2, 0.75, 2.0}) {
    const double dt = step_of<2>(own_stiffness, {linear, 0});
    const double stiffness = shared_stiffness + own_stiffness;
    const double a = stiffness * c * c / (h * h), b = stiffness * linear * c / h;

    CHECK(stays_bounded(a, b, 0.99 * dt));
    CHECK_FALSE(stays_bounded(a, b, 1.01 * dt));
  }
}

TEST_CASE("bodies approach by no more than a tenth of a cell in the contact time step")
{
  CHECK(contact_time_step(0.01, 300) * 300 == Approx(0.001));
  CHECK(std::isinf(contact_time_step(0.01, 0)));
}

TEMPLATE_TEST_CASE_SIG("in lanes each particle has the viscous pressure and the bounds of scalar code", "",
                       ((int D), D), 2, 3)
{
  constexpr double h = 0.01;
  const ArtificialViscosity viscosity{0.2, 2};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<StiffParticle<D>> alone;
  for (std::size_t l = 0; l < n_lanes; ++l) {
    alone.push_back({.density = 2 + uniform(random),
                     .bulk_modulus = 50 + uniform(random),
                     .shear_modulus = 20 + uniform(random),
                     .velocity = Vector<D>::NullaryExpr([&] { return uniform(random); }),
                     .volume_rate = l == 0 ? 0 : 100 * uniform(random),
                     .own_stiffness = 1 + uniform(random)});
  }
  const auto lanes = [&](auto member) { return each_lane([&](std::size_t l) { return alone[l].*member; }); };
  using Alone = StiffParticle<D>;
  StiffParticle<D, Lanes> together{.density = lanes(&Alone::density),
                                   .bulk_modulus = lanes(&Alone::bulk_modulus),
                                   .shear_modulus = lanes(&Alone::shear_modulus),
                                   .velocity = {},
                                   .volume_rate = lanes(&Alone::volume_rate),
                                   .own_stiffness = lanes(&Alone::own_stiffness)};
  for (int k = 0; k < D; ++k) {
    together.velocity[k] = each_lane([&](std::size_t l) { return alone[l].velocity[k]; });
  }

  const Lanes q = viscosity.pressure(together.density, together.bulk_modulus, together.volume_rate, h);
  const Lanes viscous = viscous_time_step<D>(h, together, viscosity);
  const Lanes published = published_time_step<D>(
      h, wave_speed(together.bulk_modulus, together.shear_modulus, together.density), together.velocity);

  for (std::size_t l = 0; l < n_lanes; ++l) {
    const Alone& p = alone[l];
    CHECK(double{q[l]} == viscosity.pressure(p.density, p.bulk_modulus, p.volume_rate, h));
    CHECK(double{viscous[l]} == viscous_time_step<D>(h, p, viscosity));
    CHECK(double{published[l]} ==
          published_time_step<D>(h, wave_speed(p.bulk_modulus, p.shear_modulus, p.density), p.velocity));
  }
}

}  // namespace test_time_step
