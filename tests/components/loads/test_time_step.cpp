#include <catch2/catch.hpp>

#include <cmath>

#include "components/loads/time_step.hpp"

using namespace tamp;
using namespace tamp::components;

namespace
{

/// Whether a mass on a spring of frequency `omega` with damping ratio `zeta` stays bounded under central differences
/// whose damping force is of the half step before.
bool stays_bounded(double omega, double zeta, double dt)
{
  double x = 1, v = 0;
  for (int i = 0; i < 20000; ++i) {
    v += dt * (-omega * omega * x - 2 * zeta * omega * v);
    x += dt * v;
    if (!(std::abs(x) < 1e6)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the published time step is the least over the axes of cell size over signal speed")
{
  CHECK(published_time_step<2>(0.01, 400, {100, -50}) == Approx(0.01 / 500));
  CHECK(published_time_step<3>(0.01, 400, {0, 0, -600}) == Approx(0.01 / 1000));
}

TEST_CASE("without viscosity the viscous time step is the cell size over the signal speed")
{
  const ArtificialViscosity none{0, 0};

  CHECK(viscous_time_step<2>(0.01, 400, {60, -80}, -1000, none) == Approx(0.01 / 500));
}

TEST_CASE("viscosity shortens the time step, by its quadratic part only in compression")
{
  const ArtificialViscosity viscosity{0.2, 2};
  const Vector<3> at_rest = Vector<3>::Zero();

  // h |Dkk| / c = 0.01 * 11000 / 400 = 0.275: zeta = 0.2 + 2 * 0.275 = 0.75, and sqrt(1 + 0.75^2) - 0.75 = 0.5.
  CHECK(viscous_time_step<3>(0.01, 400, at_rest, -11000, viscosity) == Approx(0.5 * 0.01 / 400));
  CHECK(viscous_time_step<3>(0.01, 400, at_rest, 11000, viscosity) == Approx((std::sqrt(1.04) - 0.2) * 0.01 / 400));
}

TEST_CASE("the viscous factor is the limit of stability of damped central differences")
{
  const double wave_speed = 2, cell_size = 1;
  const double omega = 2 * wave_speed / cell_size;  // the highest mode of the grid, stable up to dt = h / c

  for (const double zeta : {0.0, 0.2, 0.75, 2.0}) {
    const double dt = viscous_time_step<2>(cell_size, wave_speed, {0, 0}, 0, ArtificialViscosity{zeta, 0});

    CHECK(stays_bounded(omega, zeta, 0.99 * dt));
    CHECK_FALSE(stays_bounded(omega, zeta, 1.01 * dt));
  }
}

TEST_CASE("bodies approach by no more than a tenth of a cell in the contact time step")
{
  CHECK(contact_time_step(0.01, 300) * 300 == Approx(0.001));
  CHECK(std::isinf(contact_time_step(0.01, 0)));
}

TEST_CASE("what particles hand back of the shortest wave bounds the step")
{
  for (const int n : {1, 2, 3, 4}) {
    // The wave falls from +1 to -1 across a cell, and a particle in the middle of its share sees the value there.
    double share = 0;
    for (int k = 0; k < n; ++k) share += std::pow(1 - 2 * (k + 0.5) / n, 2) / n;

    CHECK(transfer_step_factor(n) == Approx(1 / std::sqrt(2 - share)).epsilon(1e-14));
  }
}
