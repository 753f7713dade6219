#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "components/moduli/hermite_surface.hpp"
#include "components/moduli/network_fit.hpp"
#include "components/moduli/piecewise_network.hpp"
#include "components/moduli/range_mask.hpp"

namespace tamp::components
{

/// The sand's elasticity by a fitted network for the bulk modulus: K of elastic and plastic volumetric strain, as in
/// the report's MLP (Banerjee, Brannon, Fox, Regueiro 2021, PAR-10021867-092020-6). Strains and pressure are
/// compression positive.
///
///  - K is the network's own, not that of a grid. In tension it is the one at zero elastic strain, as published; beyond
///    the fit's elastic strains that of their end; plastic strain is held to the fit's. Where the network answers less
///    than `least_share` of the largest K in the fit's range, be it zero or negative, K is held at that share.
///  - Pressure, in state form, is the integral of this K over the elastic strain from zero, at the same plastic strain,
///    to within `pressure_tolerance` (|p| + 1e-3 K) over the fit's range, and rises with it. It is resampled on
///    construction, which takes about a second for a network of the report's shape: the kinks of K are what costs.
///  - An answer is out of range outside the fit's range, but for 0.1 % of tension, and where K is held from below.
class NetworkModulus
{
 public:
  static constexpr std::string_view type = "mlp";
  static constexpr std::string_view meaning = "a network for the bulk modulus";
  static constexpr std::string_view file = "a Keras HDF5 file of dense layers in a chain";
  /// The K of a relu network has kinks, which no smooth patches follow closely.
  static constexpr double compile_tolerance = 1e-2;

  static constexpr double pressure_tolerance = 1e-4;
  static constexpr double least_share = 1e-3;
  static constexpr double tension_in_range = 1e-3;

  /// Throws BadValue for what is no network of two inputs and one output, for a range that is empty or all in tension,
  /// for scalings that are not finite, and for a modulus that is not, or is nowhere positive.
  explicit NetworkModulus(const NetworkFit& fit);

  ElasticPoint at(double elastic, double plastic) const { return point_at(elastic, plastic); }
  ElasticPointOf<Lanes> at(const Lanes& elastic, const Lanes& plastic) const { return point_at(elastic, plastic); }
  double rate_modulus(double /*pressure*/, double elastic, double plastic) const
  {
    return modulus_.at(elastic, plastic);
  }
  Lanes rate_modulus(const Lanes& /*pressure*/, const Lanes& elastic, const Lanes& plastic) const
  {
    return modulus_.at(elastic, plastic);
  }
  double modulus_by_plastic(double elastic, double plastic) const
  {
    return modulus_.with_slopes(elastic, plastic).by_plastic;
  }
  bool in_range(double elastic, double plastic) const { return in_range_(elastic, plastic); }
  bool rate_in_range(double /*pressure*/, double elastic, double plastic) const { return in_range(elastic, plastic); }
  StrainRange range() const { return modulus_.range; }

  /// Along one line of equal plastic strain, elastic strains ascending, the pressure as the integral itself.
  void on_line(double plastic, std::span<const double> elastic, std::span<SurfaceNode> nodes) const
  {
    std::int64_t samples_left = most_samples;
    modulus_.on_line(plastic, elastic, nodes, samples_left);
  }

  double least_bulk_modulus() const { return modulus_.least; }
  const SurfaceErrors& pressure_errors() const { return pressure_.errors(); }

 private:
  /// Strain to an input of the network.
  struct Input {
    double mean, per_deviation;

    explicit Input(const Scaling& scaling);
    template <class Number>
    Number operator()(const Number& strain) const
    {
      return (strain - mean) * per_deviation;
    }
  };

  /// Gradients of the network that its pressure may take; that of the shipped network takes 3 million.
  static constexpr std::int64_t most_samples = 12'000'000;

  /// K of the strains, with its bounds.
  struct Modulus {
    Input elastic, plastic;
    double mean, deviation;  // mean and standard deviation of K
    StrainRange range;
    PiecewiseNetwork network;
    double least;  // K

    explicit Modulus(const NetworkFit& fit);
    double largest() const;  // largest K of a sample over the range

    // In this order a strain that is not a number counts as the least.
    template <class Number>
    Number held_elastic(const Number& e) const
    {
      return lesser_of<Number>(greater_of<Number>(0.0, e), range.most_elastic);
    }
    template <class Number>
    Number held_plastic(const Number& ep) const
    {
      return lesser_of<Number>(greater_of<Number>(range.least_plastic, ep), range.most_plastic);
    }

    template <class Number>
    Number at(const Number& e, const Number& ep) const
    {
      const Number scaled = network.value(elastic(held_elastic(e)), plastic(held_plastic(ep)));
      return greater_of<Number>(mean + deviation * scaled, least);
    }
    struct Slopes {
      double bulk_modulus, by_elastic, by_plastic;
    };
    Slopes with_slopes(double e, double ep) const;
    void on_line(double ep, std::span<const double> e, std::span<SurfaceNode> nodes, std::int64_t& samples_left) const;
  };
  static HermiteSurface pressure_of(const Modulus& modulus);

  template <class Number>
  ElasticPointOf<Number> point_at(const Number& elastic, const Number& plastic) const
  {
    const ElasticPointOf<Number> on_surface = pressure_.at(elastic, plastic);
    return {on_surface.pressure, modulus_.at(elastic, plastic), on_surface.coupling};
  }

  Modulus modulus_;
  HermiteSurface pressure_;
  RangeMask in_range_;
};

}  // namespace tamp::components
