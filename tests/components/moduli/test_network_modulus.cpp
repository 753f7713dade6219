#include "components/moduli/network_modulus.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "components/errors.hpp"
#include "tests/components/moduli/random_network.hpp"

namespace test_network_modulus
{

using tamp::components::Activation;
using tamp::components::BadValue;
using tamp::components::DenseNetwork;
using tamp::components::ElasticModel;
using tamp::components::ElasticPoint;
using tamp::components::NetworkFit;
using tamp::components::NetworkModulus;

static_assert(ElasticModel<NetworkModulus>);

namespace
{

/// K = 1 GPa + 20 GPa elastic + 5 GPa plastic, over elastic strains to 0.1 and plastic ones to 0.3.
NetworkFit plane()
{
  return {{{Activation::linear, 2, 1, {20, 5}, {1}}}, {0, 0}, {0, 0}, {0, 1e9}, {0, 0.1, 0, 0.3}};
}

/// K between about 1 and 3 GPa.
NetworkFit bent(Activation activation)
{
  return {random_network::layers({2, 8, 8, 1}, activation, Activation::tanh),
          {0.05, 0.03},
          {0.15, 0.1},
          {2e9, 1e9},
          {0, 0.1, 0, 0.3}};
}

double bulk_modulus(const NetworkFit& fit, double elastic, double plastic)
{
  const double scaled = DenseNetwork(fit.layers)
                            .value((elastic - fit.elastic.mean) / fit.elastic.deviation,
                                   (plastic - fit.plastic.mean) / fit.plastic.deviation);
  return fit.bulk_modulus.mean + fit.bulk_modulus.deviation * scaled;
}

/// Simpson's rule, halving until it no longer changes.
template <class F>
double integral(const F& f, double a, double b, double at_a, double at_middle, double at_b, int depth = 0)
{
  const double middle = 0.5 * (a + b), left = f(0.5 * (a + middle)), right = f(0.5 * (middle + b));
  const double coarse = (b - a) / 6 * (at_a + 4 * at_middle + at_b);
  const double fine = (b - a) / 12 * (at_a + 4 * left + 2 * at_middle + 4 * right + at_b);
  if (depth > 3 && (depth == 30 || std::abs(fine - coarse) <= 1e-9 * std::abs(fine))) return fine;
  return integral(f, a, middle, at_a, left, at_middle, depth + 1) +
         integral(f, middle, b, at_middle, right, at_b, depth + 1);
}
template <class F>
double integral(const F& f, double a, double b)
{
  return integral(f, a, b, f(a), f(0.5 * (a + b)), f(b));
}

}  // namespace

TEST_CASE("the modulus of a network is the network's answer to standardised strains, scaled back")
{
  const NetworkFit fit = bent(Activation::relu);
  const NetworkModulus model(fit);

  for (double elastic = 0; elastic < 0.1; elastic += 0.007) {
    for (double plastic = 0; plastic < 0.3; plastic += 0.019) {
      const Approx expected = Approx(bulk_modulus(fit, elastic, plastic)).epsilon(1e-12);
      CHECK(model.at(elastic, plastic).bulk_modulus == expected);
      CHECK(model.rate_modulus(1e6, elastic, plastic) == expected);
      CHECK(model.in_range(elastic, plastic));
    }
  }
}

TEST_CASE("a deviation of zero counts as one")
{
  NetworkFit fit = plane();
  fit.bulk_modulus = {1e9, 0};
  fit.elastic.mean = 0.02;
  const NetworkModulus model(fit);

  CHECK(model.rate_modulus(0, 0.05, 0.1) == Approx(1e9 + 20 * 0.03 + 5 * 0.1 + 1));
}

TEST_CASE("pressure is the integral of a network's modulus within the stated bound")
{
  for (const Activation activation : {Activation::relu, Activation::tanh}) {
    const NetworkFit fit = bent(activation);
    const DenseNetwork network(fit.layers);
    const NetworkModulus model(fit);

    double worst = 0;
    for (double elastic = 1e-4; elastic < 0.1; elastic *= 1.3) {
      for (double plastic = 0.003; plastic < 0.3; plastic += 0.037) {
        const auto k = [&](double e) { return model.rate_modulus(0, e, plastic); };
        const double expected = integral(k, 0, elastic);
        const ElasticPoint point = model.at(elastic, plastic);
        worst = std::max(worst, std::abs(point.pressure - expected) / (expected + 1e-3 * point.bulk_modulus));
      }
    }
    CHECK(worst < NetworkModulus::pressure_tolerance);
    CHECK(model.pressure_errors().pressure <= NetworkModulus::pressure_tolerance);
  }
}

TEST_CASE("modulus and coupling of a network are the derivatives of its pressure")
{
  const NetworkModulus model(bent(Activation::tanh));
  constexpr double step = 1e-5;

  for (double elastic = 0.01; elastic < 0.1; elastic += 0.011) {
    for (double plastic = 0.01; plastic < 0.3; plastic += 0.023) {
      const ElasticPoint point = model.at(elastic, plastic);
      const double change = model.at(elastic + step, plastic).pressure - model.at(elastic - step, plastic).pressure;
      CHECK(point.bulk_modulus == Approx(change / (2 * step)).epsilon(5e-3));
      const double coupled = model.at(elastic, plastic + step).pressure - model.at(elastic, plastic - step).pressure;
      CHECK(point.coupling == Approx(coupled / (2 * step)).epsilon(1e-3).margin(1e-4 * point.bulk_modulus));
      const double stiffer =
          model.rate_modulus(0, elastic, plastic + step) - model.rate_modulus(0, elastic, plastic - step);
      CHECK(model.modulus_by_plastic(elastic, plastic) == Approx(stiffer / (2 * step)).epsilon(1e-5).margin(1e4));
    }
  }
}

TEST_CASE("a network that is a plane has the pressure that is written down")
{
  const NetworkModulus model(plane());

  const ElasticPoint point = model.at(0.04, 0.2);

  CHECK(point.pressure == Approx(0.04 * 1e9 + 0.5 * 20e9 * 0.04 * 0.04 + 5e9 * 0.2 * 0.04).epsilon(1e-12));
  CHECK(point.bulk_modulus == Approx(1e9 + 20e9 * 0.04 + 5e9 * 0.2));
  CHECK(point.coupling == Approx(5e9 * 0.04));
  CHECK(model.modulus_by_plastic(0.04, 0.2) == Approx(5e9));
}

TEST_CASE("in tension a network's pressure goes on straight with the modulus at zero strain")
{
  const NetworkModulus model(plane());

  const ElasticPoint point = model.at(-0.02, 0.2);

  CHECK(point.pressure == Approx(-0.02 * 2e9));
  CHECK(point.bulk_modulus == Approx(2e9));
  CHECK(point.coupling == Approx(-0.02 * 5e9));
  CHECK(model.rate_modulus(-1e6, -0.02, 0.2) == Approx(2e9));
  CHECK_FALSE(model.in_range(-0.02, 0.2));
}

TEST_CASE("a network fitted in tension too has the same tension, and has it in range")
{
  NetworkFit fit = plane();
  fit.range.least_elastic = -0.1;
  const NetworkModulus model(fit);

  CHECK(model.at(-0.02, 0.2).pressure == Approx(-0.02 * 2e9));
  CHECK(model.in_range(-0.02, 0.2));
  CHECK(model.range().least_elastic == -0.1);
}

TEST_CASE("beyond the elastic strains of its fit a network keeps its last modulus")
{
  const NetworkModulus model(plane());
  const ElasticPoint end = model.at(0.1, 0.2);

  const ElasticPoint beyond = model.at(0.15, 0.2);

  CHECK(beyond.bulk_modulus == end.bulk_modulus);
  CHECK(beyond.pressure == Approx(end.pressure + 0.05 * end.bulk_modulus));
  CHECK(model.rate_modulus(1e9, 0.15, 0.2) == end.bulk_modulus);
  CHECK_FALSE(model.in_range(0.15, 0.2));
}

TEST_CASE("beyond the plastic strains of its fit a network is that of their end, without coupling")
{
  const NetworkModulus model(plane());

  for (const auto& [end, beyond] : {std::pair(0.0, -0.05), std::pair(0.3, 0.4)}) {
    CHECK(model.at(0.05, beyond).pressure == model.at(0.05, end).pressure);
    CHECK(model.at(0.05, beyond).bulk_modulus == model.at(0.05, end).bulk_modulus);
    CHECK(model.at(0.05, beyond).coupling == 0);
    CHECK(model.modulus_by_plastic(0.05, beyond) == 0);
    CHECK_FALSE(model.in_range(0.05, beyond));
    CHECK(model.in_range(0.05, end));
  }
}

TEST_CASE("where a network's modulus is not positive it is held at a small one, and the pressure still rises")
{
  NetworkFit fit = plane();
  fit.layers[0].bias = {-1};  // K is positive from elastic strain 0.05 - plastic / 4 on, and 2.5 GPa at the most
  const NetworkModulus model(fit);
  const double least = 1e-3 * 2.5e9;

  CHECK(model.least_bulk_modulus() == Approx(least));
  CHECK(model.at(0.04, 0).bulk_modulus == Approx(least));
  CHECK(model.at(-0.04, 0).bulk_modulus == Approx(least));
  CHECK(model.modulus_by_plastic(0.04, 0) == 0);
  CHECK_FALSE(model.in_range(0.04, 0));
  CHECK(model.in_range(0.06, 0));
  CHECK(model.at(0.04, 0).pressure == Approx(0.04 * least).margin(1e-4 * 1e-3 * least));
  CHECK(model.at(0.07, 0).pressure == Approx(0.5 * 20e9 * 0.02 * 0.02 + 0.05 * least).epsilon(1e-3));
  double last = model.at(-0.01, 0.03).pressure;
  for (double elastic = -0.009; elastic < 0.12; elastic += 1e-4) {
    const double pressure = model.at(elastic, 0.03).pressure;
    CHECK(pressure > last);
    last = pressure;
  }
}

TEST_CASE("a network modulus is not made from numbers that are no range or scaling, or nowhere stiff")
{
  const auto refused = [](const NetworkFit& fit, const std::string& words) {
    CHECK_THROWS_AS(NetworkModulus(fit), BadValue);
    CHECK_THROWS_WITH(NetworkModulus(fit), Catch::Contains(words));
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();

  NetworkFit fit = plane();
  fit.range.most_elastic = 0;
  refused(fit, "elastic strains from");
  fit = plane();
  fit.range = {-0.2, -0.1, 0, 0.3};
  refused(fit, "elastic strains from");
  fit = plane();
  fit.range.most_plastic = infinity;
  refused(fit, "plastic strains from");
  fit = plane();
  fit.range.least_plastic = 0.3;
  refused(fit, "plastic strains from");
  fit = plane();
  fit.elastic.mean = std::nan("");
  refused(fit, "scaling of elastic strain");
  fit = plane();
  fit.plastic.deviation = -1;
  refused(fit, "scaling of plastic strain");
  fit = plane();
  fit.bulk_modulus.deviation = infinity;
  refused(fit, "scaling of bulk modulus");
  fit = plane();
  fit.layers[0].bias = {-10};
  refused(fit, "nowhere positive");
  fit = plane();
  fit.layers[0].bias = {1e300};
  refused(fit, "not finite");
  fit = plane();
  fit.layers.clear();
  refused(fit, "without a layer");
}

TEST_CASE("a network modulus is not made from a network that is too rough to integrate")
{
  NetworkFit fit = bent(Activation::relu);
  fit.layers = random_network::layers({2, 4, 1}, Activation::relu, Activation::tanh);
  fit.elastic.deviation = fit.plastic.deviation = 1e-5;
  CHECK_THROWS_WITH(NetworkModulus(fit), Catch::Contains("too rough to integrate"));
}

}  // namespace test_network_modulus
