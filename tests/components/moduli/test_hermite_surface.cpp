#include "components/moduli/hermite_surface.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "components/errors.hpp"

namespace test_hermite_surface
{

using tamp::components::BadValue;
using tamp::components::ElasticPoint;
using tamp::components::HermiteSurface;
using tamp::components::StrainRange;
using tamp::components::SurfaceLine;
using tamp::components::SurfaceNode;

namespace
{

constexpr StrainRange sand{-0.01, 0.1, 0, 0.3};
constexpr double not_asked = std::numeric_limits<double>::infinity();

/// The surface that `node` gives point by point.
template <class Node>
SurfaceLine line_of(const Node& node)
{
  return [node](double plastic, std::span<const double> elastic, std::span<SurfaceNode> nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = node(elastic[i], plastic);
  };
}

/// p = (exp(100 e) - 1) exp(20 ep) MPa
SurfaceNode smooth(double e, double ep)
{
  const double a = 100, b = 20, x = std::exp(a * e), y = 1e6 * std::exp(b * ep);
  return {(x - 1) * y, a * x * y, b * (x - 1) * y, a * b * x * y};
}

/// K = 1 GPa + 100 GPa max(e + ep / 4 - 0.06, 0): a kink across both strains.
SurfaceNode kinked(double e, double ep)
{
  const auto positive = [](double x) { return std::max(x, 0.0); };
  const double at = e + 0.25 * ep - 0.06, start = positive(0.25 * ep - 0.06), slope = 100e9;
  return {1e9 * e + 0.5 * slope * (positive(at) * positive(at) - start * start), 1e9 + slope * positive(at),
          0.25 * slope * (positive(at) - start), at > 0 ? 0.25 * slope : 0};
}

struct Worst {
  double pressure = 0, bulk_modulus = 0;
};

/// The largest errors at 20000 random states, in the measures of SurfaceTolerance.
template <class Node>
Worst worst_of(const HermiteSurface& surface, const Node& node)
{
  std::mt19937 random(11);
  const StrainRange& range = surface.range();
  std::uniform_real_distribution<double> elastic(range.least_elastic, range.most_elastic);
  std::uniform_real_distribution<double> plastic(range.least_plastic, range.most_plastic);
  Worst worst;
  for (int i = 0; i < 20000; ++i) {
    const double e = elastic(random), ep = plastic(random);
    const SurfaceNode exact = node(e, ep);
    const ElasticPoint found = surface.at(e, ep);
    const double k = exact.bulk_modulus, p = std::abs(exact.pressure) + 1e-3 * k;
    worst.pressure = std::max(worst.pressure, std::abs(found.pressure - exact.pressure) / p);
    worst.bulk_modulus = std::max(worst.bulk_modulus, std::abs(found.bulk_modulus - k) / k);
  }
  return worst;
}

}  // namespace

TEST_CASE("a smooth surface is within its tolerance everywhere, and says how far it is")
{
  const HermiteSurface surface(sand, line_of(smooth), {1e-5, 1e-5});

  const Worst worst = worst_of(surface, smooth);
  CHECK(worst.pressure < 1e-5);
  CHECK(worst.bulk_modulus < 1e-5);
  CHECK(surface.errors().pressure < 1e-5);
  CHECK(surface.errors().bulk_modulus < 1e-5);
  CHECK(surface.errors().bulk_modulus > 0.5 * worst.bulk_modulus);
  CHECK(surface.errors().n_samples == 49 * surface.errors().n_patches);
}

TEST_CASE("modulus, coupling and mixed derivative are those of the surface's own pressure")
{
  const HermiteSurface surface(sand, line_of(smooth), {1e-4, 1e-4});
  const auto pressure = [&](double e, double ep) { return surface.at(e, ep).pressure; };
  const auto modulus = [&](double e, double ep) { return surface.at(e, ep).bulk_modulus; };

  const double h = 1e-6;
  for (double e : {-0.02, -0.003, 0.0407, 0.0911, 0.15}) {
    for (double ep : {0.0123, 0.1711, 0.2809}) {
      const ElasticPoint point = surface.at(e, ep);
      CHECK(point.bulk_modulus == Approx((pressure(e + h, ep) - pressure(e - h, ep)) / (2 * h)).epsilon(1e-6));
      CHECK(point.coupling == Approx((pressure(e, ep + h) - pressure(e, ep - h)) / (2 * h)).epsilon(1e-6));
      CHECK(surface.modulus_by_plastic(e, ep) ==
            Approx((modulus(e, ep + h) - modulus(e, ep - h)) / (2 * h)).epsilon(1e-6));
    }
  }
}

TEST_CASE("pressure, modulus and coupling are continuous where large patches meet small ones")
{
  const HermiteSurface surface(sand, line_of(kinked), {1e-3, 1e-3});

  // Closer than any two edges, across all of them.
  double pressure = 0, bulk_modulus = 0, coupling = 0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  const double width = 0.01 / 48, height = 0.3 / 32;
  for (int i = 0; i < 200000; ++i) {
    // Edges of patches that were cut n times lie at multiples of 1 / 2^n squares.
    const double cuts = std::exp2(std::floor(8 * share(random)));
    const double edge_e = std::floor(share(random) * 480 * cuts) / cuts * width;
    const double edge_p = std::ceil(share(random) * (32 * cuts - 1)) / cuts * height;
    const bool across = share(random) < 0.5;
    const double e = across ? edge_e : 0.1 * share(random), ep = across ? 0.3 * share(random) : edge_p;
    const double de = across ? 1e-13 : 0, dp = across ? 0 : 1e-13;
    const ElasticPoint a = surface.at(e - de, ep - dp), b = surface.at(e + de, ep + dp);
    pressure = std::max(pressure, std::abs(a.pressure - b.pressure));
    bulk_modulus = std::max(bulk_modulus, std::abs(a.bulk_modulus - b.bulk_modulus));
    coupling = std::max(coupling, std::abs(a.coupling - b.coupling));
  }
  CHECK(pressure < 0.1);     // of up to 0.5 GPa
  CHECK(bulk_modulus < 10);  // of up to 12 GPa
  CHECK(coupling < 10);
}

TEST_CASE("a surface with a kink in the modulus is within its tolerance")
{
  const HermiteSurface surface(sand, line_of(kinked), {1e-4, 2e-3});

  const Worst worst = worst_of(surface, kinked);
  CHECK(worst.pressure < 1.1e-4);
  CHECK(worst.bulk_modulus < 2.2e-3);
}

TEST_CASE("a kink along a seam costs nothing")
{
  const auto bent = [](double e, double ep) {
    const double over = std::max(ep - 0.12345, 0.0);
    return SurfaceNode{1e9 * e * (1 + over * over), 1e9 * (1 + over * over), 2e9 * e * over, 2e9 * over};
  };

  const HermiteSurface plain(sand, line_of(bent), {1e-7, 1e-7});
  const HermiteSurface with_seam(sand, line_of(bent), {1e-7, 1e-7}, {{}, {0.12345}});

  CHECK(with_seam.errors().bulk_modulus < 1e-12);
  CHECK(with_seam.errors().n_patches < plain.errors().n_patches);
}

TEST_CASE("half the tolerance takes more patches, and a modulus that is not asked for fewer")
{
  const auto n_patches = [](double pressure, double bulk_modulus) {
    return HermiteSurface(sand, line_of(kinked), {pressure, bulk_modulus}).errors().n_patches;
  };

  const std::size_t n = n_patches(4e-4, 4e-3);

  CHECK(n_patches(2e-4, 2e-3) > n);
  CHECK(n_patches(4e-4, not_asked) < n);
}

TEST_CASE("beyond its range a surface goes on straight in elastic strain, and is held in plastic strain")
{
  const HermiteSurface surface(sand, line_of(smooth), {1e-4, 1e-4});
  const ElasticPoint end = surface.at(0.1, 0.2), start = surface.at(-0.01, 0.2);

  CHECK(surface.at(0.15, 0.2).pressure == Approx(end.pressure + 0.05 * end.bulk_modulus).epsilon(1e-12));
  CHECK(surface.at(0.15, 0.2).bulk_modulus == end.bulk_modulus);
  CHECK(surface.at(-0.05, 0.2).pressure == Approx(start.pressure - 0.04 * start.bulk_modulus).epsilon(1e-12));
  CHECK(surface.at(0.03, 0.5).pressure == surface.at(0.03, 0.3).pressure);
  CHECK(surface.at(0.03, 0.5).coupling == 0);
  CHECK(surface.modulus_by_plastic(0.03, -0.1) == 0);
}

TEST_CASE("states on the ends of the range, and none at all, have an answer")
{
  const HermiteSurface surface(sand, line_of(smooth), {1e-4, 1e-4});
  const double none = std::numeric_limits<double>::quiet_NaN();

  CHECK(surface.at(0.1, 0.3).pressure == Approx(smooth(0.1, 0.3).pressure).epsilon(1e-12));
  CHECK(surface.at(-0.01, 0).pressure == Approx(smooth(-0.01, 0).pressure).epsilon(1e-12));
  CHECK(std::isnan(surface.at(none, 0.1).pressure));
}

TEST_CASE("a surface that would take too many patches is refused with what was reached")
{
  const auto jump = [](double e, double ep) { return SurfaceNode{1e9 * e, e > 0.3 * ep + 0.0123 ? 2e9 : 1e9, 0, 0}; };
  const auto refused = [&](const auto& node) {
    try {
      HermiteSurface(sand, line_of(node), {1e-3, 1e-3});
    } catch (const BadValue& bad) {
      return bad;
    }
    return BadValue("nothing", "a refusal");
  };

  const BadValue bad = refused(jump);
  CHECK(bad.found.find("of the bulk modulus after") != std::string::npos);
  CHECK(bad.expected.find("within 0.001 of the pressure") != std::string::npos);
  CHECK(refused([](double, double) { return SurfaceNode{0, 0, 0, 0}; }).found != "nothing");
}

TEST_CASE("a surface over no range is refused")
{
  CHECK_THROWS_AS(HermiteSurface({0.1, 0.1, 0, 0.3}, line_of(smooth), {1e-3, 1e-3}), BadValue);
}

}  // namespace test_hermite_surface
