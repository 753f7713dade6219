#include "components/moduli/support_vector_modulus.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "components/errors.hpp"
#include "tests/components/moduli/jittered_fit.hpp"

namespace test_support_vector_modulus
{

using tamp::components::BadValue;
using tamp::components::ElasticPoint;
using tamp::components::StrainRange;
using tamp::components::SupportVectorFit;
using tamp::components::SupportVectorModulus;
using tamp::components::ZeroPressure;

namespace
{

struct Derivatives {
  double pressure, by_total, by_plastic, by_total_total, by_total_plastic;
};

/// The fit as its definition has it.
Derivatives plain(const SupportVectorFit& fit, double elastic, double plastic)
{
  const double x1 = ((elastic + plastic) / fit.total.unit - fit.total.lower) * fit.total.scale;
  const double x2 = (plastic / fit.plastic.unit - fit.plastic.lower) * fit.plastic.scale;
  const double per_total = fit.total.scale / fit.total.unit, per_plastic = fit.plastic.scale / fit.plastic.unit;
  Derivatives sum{};
  for (std::size_t j = 0; j < fit.vectors.size(); ++j) {
    const double d1 = fit.vectors[j][0] - x1, d2 = fit.vectors[j][1] - x2;
    const double term = fit.coefficients[j] * std::exp(-fit.gamma * (d1 * d1 + d2 * d2));
    sum.pressure += term;
    sum.by_total += term * 2 * fit.gamma * d1;
    sum.by_plastic += term * 2 * fit.gamma * d2;
    sum.by_total_total += term * 2 * fit.gamma * (2 * fit.gamma * d1 * d1 - 1);
    sum.by_total_plastic += term * 4 * fit.gamma * fit.gamma * d1 * d2;
  }
  const double unit = fit.pressure_unit / fit.pressure_scale;
  return {unit * (sum.pressure + fit.intercept) + fit.pressure_unit * fit.pressure_lower,
          unit * sum.by_total * per_total, unit * sum.by_plastic * per_plastic,
          unit * sum.by_total_total * per_total * per_total, unit * sum.by_total_plastic * per_total * per_plastic};
}

/// The greatest difference, in parts of the greatest value.
class Comparison
{
 public:
  void operator()(double found, double expected)
  {
    difference_ = std::max(difference_, std::abs(found - expected));
    greatest_ = std::max(greatest_, std::abs(expected));
  }
  double worst() const { return difference_ / greatest_; }

 private:
  double difference_ = 0, greatest_ = 0;
};

struct State {
  double elastic, plastic;
};

/// States of the box that the model trusts.
std::vector<State> trusted_states(const SupportVectorModulus& model)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> total(-0.1, 0.45), plastic(0, 0.32);
  std::vector<State> states;
  for (int i = 0; i < 2000; ++i) {
    const double ep = plastic(random), ee = total(random) - ep;
    if (model.in_range(ee, ep)) states.push_back({ee, ep});
  }
  return states;
}

BadValue refusal(const SupportVectorFit& fit)
{
  try {
    const SupportVectorModulus model(fit, ZeroPressure::as_fitted);
  } catch (const BadValue& bad) {
    return bad;
  }
  return {"nothing", "a refusal", -2};
}

}  // namespace

TEST_CASE("the expanded pressure is the direct sum over the support vectors to 1e-12 of its range")
{
  for (const double gamma : {0.5, 4.7, 40.0}) {
    const SupportVectorFit fit = jittered_fit(gamma);
    const SupportVectorModulus model(fit, ZeroPressure::as_fitted);
    const std::vector<State> states = trusted_states(model);

    Comparison pressure;
    for (const auto [ee, ep] : states) pressure(model.at(ee, ep).pressure, plain(fit, ee, ep).pressure);

    CHECK(states.size() > 500);
    CHECK(pressure.worst() < 1e-12);
  }
}

TEST_CASE("modulus and coupling are the derivatives of the direct sum over the support vectors")
{
  for (const double gamma : {0.5, 4.7, 40.0}) {
    const SupportVectorFit fit = jittered_fit(gamma);
    const SupportVectorModulus model(fit, ZeroPressure::as_fitted);

    Comparison modulus, coupling, modulus_by_plastic;
    for (const auto [ee, ep] : trusted_states(model)) {
      const Derivatives direct = plain(fit, ee, ep);
      const ElasticPoint point = model.at(ee, ep);
      modulus(point.bulk_modulus, direct.by_total);
      coupling(point.coupling, direct.by_total + direct.by_plastic);
      modulus_by_plastic(model.modulus_by_plastic(ee, ep), direct.by_total_total + direct.by_total_plastic);
    }

    CHECK(modulus.worst() < 1e-10);
    CHECK(coupling.worst() < 1e-10);
    CHECK(modulus_by_plastic.worst() < 1e-10);
  }
}

TEST_CASE("coupling and modulus by plastic strain are slopes of what the SVR answers, trusted or beyond")
{
  const double h = 1e-6;
  const SupportVectorFit soft_in_tension = jittered_fit(4.7, 0.2), soft_in_compression = jittered_fit(0.5);

  for (const SupportVectorModulus& model :
       {SupportVectorModulus(soft_in_tension, ZeroPressure::as_fitted),
        SupportVectorModulus(soft_in_tension, ZeroPressure::at_zero_elastic_strain),
        SupportVectorModulus(soft_in_compression, ZeroPressure::at_zero_elastic_strain)}) {
    for (const double ee : {-0.3, -0.15, -0.05, 0.001, 0.1, 0.3, 0.5}) {
      for (const double ep : {0.0103, 0.1011, 0.2007, 0.3109}) {
        const ElasticPoint before = model.at(ee, ep - h), after = model.at(ee, ep + h), point = model.at(ee, ep);
        const double coupling = (after.pressure - before.pressure) / (2 * h);
        const double modulus_by_plastic = (after.bulk_modulus - before.bulk_modulus) / (2 * h);
        const double allowed = 1e-6 * point.bulk_modulus;
        CHECK(point.coupling == Approx(coupling).epsilon(1e-6).margin(allowed));
        CHECK(model.modulus_by_plastic(ee, ep) == Approx(modulus_by_plastic).epsilon(1e-6).margin(allowed));
      }
    }
  }
}

TEST_CASE("a fit whose pressure is zero at elastic strain zero keeps its moduli")
{
  const SupportVectorFit fit = jittered_fit(4.7);
  const SupportVectorModulus as_fitted(fit, ZeroPressure::as_fitted);
  const SupportVectorModulus anchored(fit, ZeroPressure::at_zero_elastic_strain);

  for (const double ep : {0.0, 0.07, 0.2, 0.32}) {
    const double zero = as_fitted.at(0, ep).pressure;
    CHECK(std::abs(zero) > 1e6);
    CHECK(std::abs(anchored.at(0, ep).pressure) < 1e-12 * std::abs(as_fitted.at(0.13, 0.32).pressure));
    for (const double ee : {-0.2, -0.01, 0.04, 0.2}) {
      CHECK(anchored.at(ee, ep).pressure == Approx(as_fitted.at(ee, ep).pressure - zero).epsilon(1e-10));
      CHECK(anchored.at(ee, ep).bulk_modulus == Approx(as_fitted.at(ee, ep).bulk_modulus).epsilon(1e-11));
    }
  }
}

TEST_CASE("the rate form has the modulus of the state form, whatever the pressure")
{
  const SupportVectorModulus model(jittered_fit(4.7), ZeroPressure::at_zero_elastic_strain);

  for (const double ee : {-0.2, 0.05, 0.4}) {
    CHECK(model.rate_modulus(1e9, ee, 0.1) == model.at(ee, 0.1).bulk_modulus);
    CHECK(model.rate_modulus(-1e6, ee, 0.1) == model.rate_modulus(1e9, ee, 0.1));
  }
}

TEST_CASE("beyond the box of a fit the pressure goes straight on, without a kink at its edge")
{
  const SupportVectorModulus model(jittered_fit(40), ZeroPressure::as_fitted);
  const double ep = 0.15;

  for (const double edge : {-0.1 - ep, 0.45 - ep}) {
    const double outwards = std::copysign(1.0, edge), h = 1e-6;
    const ElasticPoint at_edge = model.at(edge, ep);
    const ElasticPoint inside = model.at(edge - h * outwards, ep), beyond = model.at(edge + 0.2 * outwards, ep);

    CHECK(model.in_range(edge - h * outwards, ep));
    CHECK_FALSE(model.in_range(edge + h * outwards, ep));
    CHECK(beyond.pressure == Approx(at_edge.pressure + 0.2 * outwards * at_edge.bulk_modulus).epsilon(1e-12));
    CHECK(beyond.bulk_modulus == Approx(at_edge.bulk_modulus).epsilon(1e-12));
    CHECK(inside.bulk_modulus == Approx(at_edge.bulk_modulus).epsilon(1e-4));
    CHECK(inside.pressure == Approx(at_edge.pressure - h * outwards * at_edge.bulk_modulus).epsilon(1e-9));
  }
}

TEST_CASE("a fit that softens to a negative modulus in tension is not followed there")
{
  const SupportVectorFit fit = jittered_fit(4.7, 0.2);
  const SupportVectorModulus model(fit, ZeroPressure::at_zero_elastic_strain);

  for (int i = 0; i <= 100; ++i) {
    const double ep = 0.00319 * i, floor = 0.05 * plain(fit, 0, ep).by_total;
    double least = std::numeric_limits<double>::infinity();
    for (int j = 0; j <= 300; ++j) least = std::min(least, model.at(-0.3 + 0.001 * j, ep).bulk_modulus);
    REQUIRE(least > (1 - 1e-9) * floor);
  }
  CHECK(plain(fit, -0.09, 0).by_total < 0);
  CHECK_FALSE(model.in_range(-0.09, 0));
  CHECK(model.in_range(-0.01, 0));
}

TEST_CASE("plastic strain beyond a fit is held at its end, and dilated sand counts as uncompacted")
{
  const SupportVectorModulus model(jittered_fit(4.7), ZeroPressure::at_zero_elastic_strain);

  CHECK(model.at(0.05, -0.2).pressure == model.at(0.05, 0).pressure);
  CHECK(model.at(0.05, 0.5).pressure == model.at(0.05, 0.32).pressure);
  for (const double ep : {-0.2, 0.5}) {
    CHECK(model.at(0.05, ep).coupling == 0);
    CHECK(model.modulus_by_plastic(0.05, ep) == 0);
    CHECK_FALSE(model.in_range(0.05, ep));
  }
}

TEST_CASE("the range of a fit is trusted all over, and no wider one is")
{
  const SupportVectorModulus model(jittered_fit(4.7, 0.2), ZeroPressure::at_zero_elastic_strain);
  const StrainRange range = model.range();

  const auto n_trusted = [&](double elastic) {
    int n = 0;
    for (int i = 0; i <= 256; ++i) n += model.in_range(elastic, 0.32 * i / 256) ? 1 : 0;
    return n;
  };

  CHECK(range.least_plastic == 0);
  CHECK(range.most_plastic == Approx(0.32));
  CHECK(n_trusted(range.least_elastic + 1e-12) == 257);
  CHECK(n_trusted(range.most_elastic - 1e-12) == 257);
  CHECK(n_trusted(range.least_elastic - 1e-6) < 257);
  CHECK(n_trusted(range.most_elastic + 1e-6) < 257);
}

TEST_CASE("a strain that is not a number has no pressure and is not in range")
{
  const SupportVectorModulus model(jittered_fit(4.7), ZeroPressure::as_fitted);
  const double nan = std::numeric_limits<double>::quiet_NaN();

  CHECK(std::isnan(model.at(nan, 0.1).pressure));
  CHECK_FALSE(model.in_range(nan, 0.1));
  CHECK_FALSE(model.in_range(0.1, nan));
}

TEST_CASE("a fit without vectors, or with other than one coefficient each, is refused")
{
  SupportVectorFit empty = jittered_fit(4.7), short_of_one = empty;
  empty.vectors.clear();
  empty.coefficients.clear();
  short_of_one.coefficients.pop_back();

  CHECK(refusal(empty).found == "no support vector");
  CHECK(refusal(short_of_one).found == "305 coefficients for 306 support vectors");
}

TEST_CASE("a fit with numbers that are not finite is refused with the vector's row")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SupportVectorFit vector = jittered_fit(4.7), coefficient = vector, intercept = vector;
  vector.vectors[5][1] = nan;
  coefficient.coefficients[9] = std::numeric_limits<double>::infinity();
  intercept.intercept = nan;

  CHECK(refusal(vector).row == 5);
  CHECK(refusal(coefficient).row == 9);
  CHECK(refusal(intercept).found == "intercept nan");
}

TEST_CASE("a fit with widths or scales that are not positive is refused")
{
  SupportVectorFit no_scale = jittered_fit(4.7), no_unit = no_scale, no_pressure_scale = no_scale, reversed = no_scale;
  no_scale.total.scale = 0;
  no_unit.plastic.unit = -0.01;
  no_pressure_scale.pressure_scale = 0;
  reversed.total.upper = -20;

  CHECK(refusal(jittered_fit(0)).found == "gamma 0.000000");
  CHECK(refusal(no_scale).found == "scale of total strain 0.000000");
  CHECK(refusal(no_unit).found == "unit of plastic strain -0.010000");
  CHECK(refusal(no_pressure_scale).found == "scale of pressure 0.000000");
  CHECK(refusal(reversed).expected == "a lower bound below the upper");
}

TEST_CASE("a fit with a kernel too narrow to be expanded is refused")
{
  CHECK(refusal(jittered_fit(401)).expected == "at most 20 times");
}

TEST_CASE("a fit that has no positive modulus at elastic strain zero is refused")
{
  SupportVectorFit softening = jittered_fit(4.7), short_box = softening, no_plastic = softening;
  for (double& coefficient : softening.coefficients) coefficient = -coefficient;
  short_box.total.upper = 20;
  no_plastic.plastic.lower = -32, no_plastic.plastic.upper = 0;

  CHECK(refusal(softening).expected == "a positive modulus at elastic strain 0");
  CHECK(refusal(short_box).found == "total strains from -0.100000 to 0.200000, plastic ones from 0.000000 to 0.320000");
  CHECK(refusal(no_plastic).found == "plastic strains up to 0.000000");
}

}  // namespace test_support_vector_modulus
