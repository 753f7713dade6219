#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "components/moduli/modulus.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/components/moduli/jittered_fit.hpp"
#include "tests/components/moduli/random_network.hpp"
#include "tests/same_bits.hpp"

namespace test_moduli_in_lanes
{

using namespace tamp::components;
using tamp::test::same_bits;

namespace
{

struct States {
  std::vector<double> pressure, elastic, plastic;

  void add(double p, double e, double ep)
  {
    pressure.push_back(p);
    elastic.push_back(e);
    plastic.push_back(ep);
  }
};

/// In and around what models are made for, on its edges, far out, and no numbers, all mixed; as many as fill no
/// register of lanes.
States states()
{
  constexpr double infinity = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> strains{0.0, -0.0, 1e-300, -1e-300, 0.1, 0.3, -1e-3, 5.0, -5.0, 700.0, -700.0, infinity, none};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> elastic(-0.05, 0.2), plastic(-0.1, 0.5), pressure(-1e6, 6e8);
  States all;
  for (const double e : strains) {
    for (const double ep : strains) all.add(pressure(random), e, ep);
    if (!std::isnan(e)) all.add(e * 1e9, elastic(random), plastic(random));
  }
  for (int i = 0; i < 2001; ++i) {
    const bool small = i % 3 == 0;
    all.add(pressure(random), elastic(random) * (small ? 1e-3 : 1), plastic(random) * (small ? 1e-2 : 1));
  }
  std::shuffle(all.elastic.begin(), all.elastic.end(), std::mt19937(1));
  std::shuffle(all.plastic.begin(), all.plastic.end(), std::mt19937(1));
  std::shuffle(all.pressure.begin(), all.pressure.end(), std::mt19937(1));
  return all;
}

template <class Model>
void check_lanes(const std::string& name, const Model& model)
{
  INFO(name);
  const States some = states();
  const std::size_t n = some.elastic.size();
  std::vector<ElasticPoint> points(n);
  std::vector<double> moduli(n);

  evaluate(model, std::span(some.elastic), std::span(some.plastic), std::span(points));
  evaluate_rate(model, std::span(some.pressure), std::span(some.elastic), std::span(some.plastic), std::span(moduli));

  bool same = true;
  for (std::size_t i = 0; i < n; ++i) {
    const ElasticPoint alone = model.at(some.elastic[i], some.plastic[i]);
    same = same && same_bits(points[i].pressure, alone.pressure) &&
           same_bits(points[i].bulk_modulus, alone.bulk_modulus) && same_bits(points[i].coupling, alone.coupling) &&
           same_bits(moduli[i], model.rate_modulus(some.pressure[i], some.elastic[i], some.plastic[i]));
  }
  CHECK(same);
}

NetworkFit network(Activation hidden, const std::vector<std::size_t>& widths)
{
  return {random_network::layers(widths, hidden, Activation::linear),
          {0.05, 0.03},
          {0.15, 0.1},
          {3e9, 1e9},
          {0, 0.1, 0, 0.3}};
}

}  // namespace

TEST_CASE("a model answers many states at once with the bits that it gives for each alone, whatever their neighbours")
{
  const SupportVectorModulus support_vectors(jittered_fit(2), ZeroPressure::at_zero_elastic_strain);
  const NetworkModulus relu(network(Activation::relu, {2, 24, 16, 1}));
  const NetworkModulus tanh(network(Activation::tanh, {2, 8, 8, 1}));

  check_lanes("table", concrete_sand::unloading());
  check_lanes("svr", support_vectors);
  check_lanes("svr as fitted", SupportVectorModulus(jittered_fit(2), ZeroPressure::as_fitted));
  check_lanes("relu", relu);
  check_lanes("tanh", tanh);
  check_lanes("compiled svr", ModulusSurface(support_vectors, 1e-3));
  check_lanes("compiled table", ModulusSurface(concrete_sand::unloading(), 1e-2));
  check_lanes("svr in engineering strain", EngineeringStrain<SupportVectorModulus>(support_vectors));
  check_lanes("network in engineering strain", EngineeringStrain<NetworkModulus>(relu));
}

}  // namespace test_moduli_in_lanes
