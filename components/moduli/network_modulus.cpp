#include "components/moduli/network_modulus.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

namespace
{

void check(const Scaling& scaling, const std::string& what)
{
  if (!std::isfinite(scaling.mean) || !std::isfinite(scaling.deviation) || scaling.deviation < 0) {
    throw BadValue("a scaling of " + what + " by mean " + std::to_string(scaling.mean) + ", deviation " +
                       std::to_string(scaling.deviation),
                   "finite numbers, the deviation not negative");
  }
}

void check(const StrainRange& range)
{
  const auto ascend = [](double least, double most) {
    return std::isfinite(least) && std::isfinite(most) && least < most;
  };
  if (!ascend(range.least_elastic, range.most_elastic) || range.most_elastic <= 0) {
    throw BadValue(
        "elastic strains from " + std::to_string(range.least_elastic) + " to " + std::to_string(range.most_elastic),
        "a range that reaches into compression");
  }
  if (!ascend(range.least_plastic, range.most_plastic)) {
    throw BadValue(
        "plastic strains from " + std::to_string(range.least_plastic) + " to " + std::to_string(range.most_plastic),
        "a range");
  }
}

const NetworkFit& checked(const NetworkFit& fit)
{
  check(fit.elastic, "elastic strain");
  check(fit.plastic, "plastic strain");
  check(fit.bulk_modulus, "bulk modulus");
  check(fit.range);
  return fit;
}

/// A deviation of zero counts as one.
double deviation_of(const Scaling& scaling)
{
  return scaling.deviation == 0 ? 1 : scaling.deviation;
}

/// The integrals of K and of dK/d(plastic) over the elastic strain from zero, at one plastic strain. A panel is cut
/// until K is straight in it or bent once, where the integrals of a relu network are exact, or else a cubic.
template <class Modulus>
class Integral
{
 public:
  /// No panel is longer than `longest`; it counts samples_left down.
  Integral(const Modulus& modulus, double plastic, double longest, std::int64_t& samples_left)
      : modulus_(modulus), plastic_(plastic), longest_(longest), samples_left_(samples_left), last_(sample(0))
  {
  }

  SurfaceNode advance_to(double elastic)
  {
    const double start = last_.elastic, n_panels = std::ceil(std::abs(elastic - start) / longest_);
    for (double i = 1; i <= n_panels; ++i) {
      const Sample next = sample(i < n_panels ? start + (elastic - start) * (i / n_panels) : elastic);
      add(last_, next);
      last_ = next;
    }
    return {pressure_, last_.bulk_modulus, coupling_, last_.by_plastic};
  }

 private:
  struct Sample {
    double elastic, bulk_modulus, by_elastic, by_plastic;

    double tangent_at(double e) const { return bulk_modulus + by_elastic * (e - elastic); }
  };

  Sample sample(double elastic) const
  {
    if (--samples_left_ < 0) {
      throw BadValue("a network whose bulk modulus is too rough to integrate", "one without jumps or noise");
    }
    const auto [bulk_modulus, by_elastic, by_plastic] = modulus_.with_slopes(elastic, plastic_);
    return {elastic, bulk_modulus, by_elastic, by_plastic};
  }
  bool agree(double one, double other) const { return std::abs(one - other) <= 1e-10 * (one + 10 * modulus_.least); }
  bool is_on_tangent(const Sample& of, double elastic) const
  {
    return agree(modulus_.at(elastic, plastic_), of.tangent_at(elastic));
  }

  void add(const Sample& a, const Sample& b)
  {
    constexpr double beside = 1e-4, least_width = 1e-8;
    const double width = b.elastic - a.elastic, kink = meeting_of_tangents(a, b);
    const double before = kink - beside * width, after = kink + beside * width;
    const bool in_line =
        agree(b.bulk_modulus, a.tangent_at(b.elastic)) && agree(a.bulk_modulus, b.tangent_at(a.elastic));
    if (is_on_tangent(a, before) && (in_line || is_on_tangent(b, after))) {
      const double left = kink - a.elastic, right = b.elastic - kink, at_kink = a.tangent_at(kink);
      pressure_ += 0.5 * (left * (a.bulk_modulus + at_kink) + right * (at_kink + b.bulk_modulus));
      coupling_ += left * a.by_plastic + right * b.by_plastic;
      return;
    }
    const Sample middle = sample(before);
    if (agree(middle.bulk_modulus, cubic_at(before, a, b)) || std::abs(width) < least_width) {
      pressure_ += width * (0.5 * (a.bulk_modulus + b.bulk_modulus) + width / 12 * (a.by_elastic - b.by_elastic));
      coupling_ += width / 6 * (a.by_plastic + 4 * middle.by_plastic + b.by_plastic);
    } else {
      add(a, middle);
      add(middle, b);
    }
  }

  /// The elastic strain of it, or the middle.
  static double meeting_of_tangents(const Sample& a, const Sample& b)
  {
    const double width = b.elastic - a.elastic, bend = a.by_elastic - b.by_elastic;
    const double share = (b.tangent_at(a.elastic) - a.bulk_modulus) / (bend * width);
    return a.elastic + width * (share > 0.01 && share < 0.99 ? share : 0.5);
  }

  /// The cubic with the values and slopes of a and b.
  static double cubic_at(double elastic, const Sample& a, const Sample& b)
  {
    const double t = (elastic - a.elastic) / (b.elastic - a.elastic), s = 1 - t;
    return s * s * (a.tangent_at(elastic) + 2 * t * a.bulk_modulus) +
           t * t * (b.tangent_at(elastic) + 2 * s * b.bulk_modulus);
  }

  const Modulus& modulus_;
  double plastic_, longest_;
  std::int64_t& samples_left_;
  Sample last_;
  double pressure_ = 0, coupling_ = 0;
};

}  // namespace

NetworkModulus::Input::Input(const Scaling& scaling) : mean(scaling.mean), per_deviation(1 / deviation_of(scaling)) {}

NetworkModulus::Modulus::Modulus(const NetworkFit& fit)
    : elastic(fit.elastic),
      plastic(fit.plastic),
      mean(fit.bulk_modulus.mean),
      deviation(deviation_of(fit.bulk_modulus)),
      range(checked(fit).range),
      network(fit.layers, {elastic(0.0), plastic(range.least_plastic)},
              {elastic(range.most_elastic), plastic(range.most_plastic)}),
      least(-std::numeric_limits<double>::infinity())
{
  least = least_share * largest();
}

double NetworkModulus::Modulus::largest() const
{
  constexpr int n_steps = 256;
  double found = 0;
  for (int i = 0; i <= n_steps; ++i) {
    const double e = range.most_elastic * i / n_steps;
    for (int j = 0; j <= n_steps; ++j) {
      const double k = at(e, range.least_plastic + (range.most_plastic - range.least_plastic) * j / n_steps);
      if (!std::isfinite(k)) throw BadValue("a network whose bulk modulus is not finite", "a finite one");
      found = std::max(found, k);
    }
  }
  if (found == 0) throw BadValue("a network whose bulk modulus is nowhere positive", "a positive one");
  return found;
}

NetworkModulus::Modulus::Slopes NetworkModulus::Modulus::with_slopes(double e, double ep) const
{
  const double held_e = held_elastic(e), held_ep = held_plastic(ep);
  const auto [scaled, by_elastic, by_plastic] = network.with_gradient(elastic(held_e), plastic(held_ep));
  const double k = mean + deviation * scaled;
  if (k <= least) return {least, 0, 0};
  return {k, held_e == e ? deviation * by_elastic * elastic.per_deviation : 0,
          held_ep == ep ? deviation * by_plastic * plastic.per_deviation : 0};
}

void NetworkModulus::Modulus::on_line(double ep, std::span<const double> e, std::span<SurfaceNode> nodes,
                                      std::int64_t& samples_left) const
{
  Integral integral(*this, ep, range.most_elastic / 32, samples_left);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = integral.advance_to(e[i]);
}

HermiteSurface NetworkModulus::pressure_of(const Modulus& modulus)
{
  const StrainRange& range = modulus.range;
  std::int64_t samples_left = most_samples;
  const auto line = [&](double plastic, std::span<const double> elastic, std::span<SurfaceNode> nodes) {
    modulus.on_line(plastic, elastic, nodes, samples_left);
  };
  constexpr SurfaceTolerance tolerance{pressure_tolerance, 0.5};  // 0.5: of K, so that the pressure always rises
  return HermiteSurface({0, range.most_elastic, range.least_plastic, range.most_plastic}, line, tolerance);
}

NetworkModulus::NetworkModulus(const NetworkFit& fit)
    : modulus_(fit),
      pressure_(pressure_of(modulus_)),
      in_range_({std::min(fit.range.least_elastic, -tension_in_range), fit.range.most_elastic, fit.range.least_plastic,
                 fit.range.most_plastic},
                [&](double e, double ep) { return modulus_.at(e, ep) > modulus_.least; })
{
}

}  // namespace tamp::components
