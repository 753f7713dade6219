#include "components/moduli/modulus_surface.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/components/materials/concrete_sand.hpp"

namespace test_modulus_surface
{

using tamp::components::ElasticModel;
using tamp::components::ElasticPoint;
using tamp::components::ElasticPointOf;
using tamp::components::ModulusSurface;
using tamp::components::StrainRange;
using tamp::components::SurfaceNode;
using tamp::components::UnloadingTable;

static_assert(ElasticModel<ModulusSurface>);

namespace
{

const ModulusSurface& compiled_table()
{
  static const ModulusSurface surface(concrete_sand::unloading(), 1e-3);
  return surface;
}

struct State {
  double elastic, plastic;
};

/// Spread over the range of the table.
std::vector<State> states(int n)
{
  const StrainRange range = concrete_sand::unloading().range();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> elastic(range.least_elastic, range.most_elastic);
  std::uniform_real_distribution<double> plastic(range.least_plastic, range.most_plastic);
  std::vector<State> all;
  all.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) all.push_back({elastic(random), plastic(random)});
  return all;
}

/// K = 1 GPa (1 + ep), by the strains alone.
struct Straight {
  template <class Number>
  ElasticPointOf<Number> at(const Number& e, const Number& ep) const
  {
    return {1e9 * (1.0 + ep) * e, 1e9 * (1.0 + ep), 1e9 * e};
  }
  template <class Number>
  Number rate_modulus(const Number&, const Number& e, const Number& ep) const
  {
    return at(e, ep).bulk_modulus;
  }
  double modulus_by_plastic(double, double) const { return 1e9; }
  bool in_range(double e, double ep) const { return e < 0.05 && ep < 0.1; }
  bool rate_in_range(double, double e, double ep) const { return in_range(e, ep); }
  StrainRange range() const { return {0, 0.1, 0, 0.3}; }
};

/// A model whose pressure, asked for one state, is a little off its integral along a line.
struct Rough : Straight {
  using Straight::at;
  ElasticPoint at(double e, double ep) const
  {
    const ElasticPoint point = Straight::at(e, ep);
    return {point.pressure * (1 + 1e-4 * std::sin(1e5 * e)), point.bulk_modulus, point.coupling};
  }
  void on_line(double ep, std::span<const double> elastic, std::span<SurfaceNode> nodes) const
  {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const ElasticPoint point = Straight::at(elastic[i], ep);
      nodes[i] = {point.pressure, point.bulk_modulus, point.coupling, 1e9};
    }
  }
};

}  // namespace

TEST_CASE("a compiled table has the table's pressure and modulus within its tolerance")
{
  const UnloadingTable& table = concrete_sand::unloading();

  double pressure = 0, bulk_modulus = 0;
  for (const auto& [e, ep] : states(20000)) {
    const ElasticPoint found = compiled_table().at(e, ep), exact = table.at(e, ep);
    const double k = exact.bulk_modulus, p = std::abs(exact.pressure) + 1e-3 * k;
    pressure = std::max(pressure, std::abs(found.pressure - exact.pressure) / p);
    bulk_modulus = std::max(bulk_modulus, std::abs(found.bulk_modulus - k) / k);
  }
  CHECK(pressure < 1e-3);
  CHECK(bulk_modulus < 1.1e-3);
  CHECK(compiled_table().tolerance() == 1e-3);
  CHECK(compiled_table().errors().bulk_modulus <= 1e-3);
  CHECK(compiled_table().errors().bulk_modulus > 0.3 * bulk_modulus);
}

TEST_CASE("a compiled table takes its rate modulus at the pressure, as the table does")
{
  const UnloadingTable& table = concrete_sand::unloading();

  for (double pressure : {-1e6, 0.0, 3e5, 2e7, 1e9}) {
    CHECK(compiled_table().rate_modulus(pressure, 0.01, 0.2) == table.rate_modulus(pressure, 0.01, 0.2));
  }
}

TEST_CASE("a compiled table is in range where the table is, but for the squares that its edge crosses")
{
  const UnloadingTable& table = concrete_sand::unloading();

  int n_different = 0, n_inside = 0;
  for (const auto& [e, ep] : states(20000)) {
    n_different += compiled_table().in_range(e, ep) != table.in_range(e, ep);
    n_inside += table.in_range(e, ep);
  }
  CHECK(n_different < 20000 / 100);
  CHECK(n_inside > 20000 / 10);
  CHECK_FALSE(compiled_table().in_range(0.2, 0.1));
  CHECK_FALSE(compiled_table().in_range(0.01, -0.1));
}

TEST_CASE("a compiled model of the strains takes its rate modulus at the strains")
{
  const ModulusSurface surface(Straight{}, 1e-4);

  CHECK(surface.rate_modulus(1e7, 0.03, 0.2) == Approx(1.2e9).epsilon(1e-12));
  CHECK(surface.modulus_by_plastic(0.03, 0.2) == Approx(1e9).epsilon(1e-10));
  CHECK(surface.in_range(0.04, 0.05));
  CHECK_FALSE(surface.in_range(0.06, 0.05));
  CHECK(surface.range().most_elastic == 0.1);
}

TEST_CASE("a model that integrates its modulus along lines is compiled from those")
{
  const ModulusSurface surface(Rough{}, 1e-4);

  CHECK(surface.errors().bulk_modulus < 1e-10);
}

TEST_CASE("a compiled model asked in compression at zero strain has no pressure")
{
  CHECK(std::abs(compiled_table().at(0, 0.15).pressure) < 1e-3 * compiled_table().at(0, 0.15).bulk_modulus * 1e-3);
}

}  // namespace test_modulus_surface
