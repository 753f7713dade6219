#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "components/curves/monotone_cubic.hpp"
#include "components/moduli/elastic_model.hpp"
#include "components/moduli/pressure_modulus.hpp"

namespace tamp::components
{

/// Pressure and bulk modulus of a sand from its measured unloading curves, each of which starts from its own plastic
/// strain. All strains are volumetric; strains and pressures are compression positive.
///
/// Two readings of the same curves:
///  - state form, `at`: pressure is a surface p(elastic, plastic). Between curves the TOTAL strain at equal pressure is
///    interpolated in the plastic strain by a monotone cubic. Total strain then always rises with plastic strain at
///    equal pressure, that is, bulk_modulus > coupling, so plastic compaction at fixed total strain always relieves
///    pressure, and a return mapping has one answer.
///  - rate form, `rate_modulus`: bulk modulus as a function of pressure, see PressureModulus: the report's Table model.
///
/// Below the first curve's plastic strain its shape is kept (as the report's tables do), negative plastic strain counts
/// as zero, and beyond the last curve the last is kept. In tension the pressure goes on straight with the modulus at
/// zero pressure. Beyond its measured end a curve keeps its last modulus until the next curve is stiffer at that
/// pressure, and then takes on the next one's.
///
/// The surface is resampled on construction: a bicubic over a grid, within 0.2 % of the definition above (the measured
/// points themselves within 0.1 %).
class UnloadingTable
{
 public:
  /// The columns of unloading.csv: rows grouped by plastic strain (ascending, not negative), each curve starting at
  /// elastic strain 0 and pressure 0, both strictly increasing. Throws BadValue, with the row, for anything else, and
  /// for curves that cross (less total strain at equal pressure after more plastic strain).
  UnloadingTable(std::span<const double> plastic_volumetric, std::span<const double> elastic_volumetric,
                 std::span<const double> pressure);

  ElasticPoint at(double elastic_volumetric, double plastic_volumetric) const
  {
    const Located here = locate(elastic_volumetric, plastic_volumetric);
    const CubicValue &p = here.pressure, &c = here.coupling;
    // `beyond` is not zero in tension and beyond the grid's end: straight on.
    return {p.value + p.slope * here.beyond, p.slope * elastic_per_spacing_,
            here.held ? 0 : c.value + c.slope * here.beyond};
  }

  double rate_modulus(double pressure, double /*elastic*/, double plastic_volumetric) const
  {
    return pressure_modulus()(pressure, plastic_volumetric);
  }
  const PressureModulus& pressure_modulus() const { return *pressure_modulus_; }

  double modulus_by_plastic(double elastic_volumetric, double plastic_volumetric) const
  {
    const Located here = locate(elastic_volumetric, plastic_volumetric);
    return here.held ? 0 : here.coupling.slope * elastic_per_spacing_;
  }

  /// On or between the measured curves: not beyond their ends, and no more than 0.1 % in tension, which was not
  /// measured.
  bool in_range(double elastic_volumetric, double plastic_volumetric) const;
  bool rate_in_range(double pressure, double /*elastic*/, double plastic_volumetric) const
  {
    return pressure_modulus().in_range(pressure, plastic_volumetric);
  }
  /// Strains that the surface covers, up to the end of the longest curve.
  StrainRange range() const { return {least_elastic, last_elastic_, 0, curve_plastic_.back()}; }

  /// Plastic strains of the curves, ascending; the surface is smooth between them.
  std::span<const double> curve_plastic() const { return curve_plastic_; }

  /// The smallest modulus of the surface, from the grid's nodes and half way between them; positive.
  double least_bulk_modulus() const { return least_bulk_modulus_; }

  /// The surface by its definition, without the grid: slow, and the reference that tests compare `at` with.
  ElasticPoint defined_at(double elastic_volumetric, double plastic_volumetric) const;

 private:
  void read_curves(std::span<const double> plastic, std::span<const double> elastic, std::span<const double> pressure);
  void extend_curves();
  void check_curves_do_not_cross() const;
  void make_surface_grid();

  /// Elastic strain at a pressure, and its derivatives, by the definition.
  struct StrainAtPressure {
    double elastic, by_plastic;
  };
  StrainAtPressure strain_at(double pressure, double plastic) const;

  static constexpr double least_elastic = -1e-3;

  // One entry a curve, the first for plastic strain zero; curves are elastic strain of pressure.
  std::vector<double> curve_plastic_;
  std::vector<std::ptrdiff_t> curve_row_;
  std::vector<MonotoneCubic> measured_;
  std::vector<MonotoneCubic> extended_;
  double last_pressure_ = 0;

  std::size_t curve_below(double plastic) const
  {
    std::size_t k = 0;
    while (k + 2 < curve_plastic_.size() && plastic >= curve_plastic_[k + 1]) ++k;
    return k;
  }

  // State form: nodes [plastic line][elastic], lines evenly spaced between each two curves. Derivatives by elastic
  // strain are per elastic spacing, the coupling is per unit of plastic strain.
  static constexpr std::size_t n_lines_a_curve = 16;  // from one curve to the next
  struct alignas(32) Node {
    double pressure, by_elastic, coupling, coupling_by_elastic;
  };

  /// Interpolates nodes from one line to the next: cubic in the plastic strain, with the coupling as slope.
  struct Across {
    double low, high, low_slope, high_slope;  // weights of values and couplings in a value
    double change, low_change, high_change;   // weights in its derivative by plastic strain

    Across(double t, double lines_per_strain)
    {
      const double s = 1 - t, spacing = 1 / lines_per_strain;
      high = t * t * (3 - 2 * t);
      low = 1 - high;
      low_slope = spacing * t * s * s;
      high_slope = -spacing * t * t * s;
      change = 6 * t * s * lines_per_strain;
      low_change = s * (1 - 3 * t);
      high_change = t * (3 * t - 2);
    }

    Node operator()(const Node& a, const Node& b) const
    {
      return {low * a.pressure + high * b.pressure + low_slope * a.coupling + high_slope * b.coupling,
              low * a.by_elastic + high * b.by_elastic + low_slope * a.coupling_by_elastic +
                  high_slope * b.coupling_by_elastic,
              change * (b.pressure - a.pressure) + low_change * a.coupling + high_change * b.coupling,
              change * (b.by_elastic - a.by_elastic) + low_change * a.coupling_by_elastic +
                  high_change * b.coupling_by_elastic};
    }
  };

  /// Cubics in the elastic strain, per spacing, at one plastic strain, which is `held` where it is outside the curves'.
  struct Located {
    CubicValue pressure, coupling;
    double beyond;  // spacings outside the grid
    bool held;
  };
  Located locate(double elastic_volumetric, double plastic_volumetric) const
  {
    const double ep = std::min(std::max(plastic_volumetric, 0.0), curve_plastic_.back());
    const std::size_t k = curve_below(ep);
    const double line = (ep - curve_plastic_[k]) * lines_per_strain_[k];
    const std::size_t j = std::min(static_cast<std::size_t>(line), n_lines_a_curve - 1);

    const double ee = std::min(std::max(elastic_volumetric, 0.0), last_elastic_);
    const double cell = ee * elastic_per_spacing_;
    const std::size_t i = std::min(static_cast<std::size_t>(cell), n_elastic_ - 2);

    const Node* const low = &nodes_[(k * n_lines_a_curve + j) * n_elastic_ + i];
    const Node* const high = low + n_elastic_;
    const Across across(line - static_cast<double>(j), lines_per_strain_[k]);
    const Node left = across(low[0], high[0]), right = across(low[1], high[1]);

    const double t = cell - static_cast<double>(i);
    return {cubic(1, left.pressure, left.by_elastic, right.pressure, right.by_elastic, t),
            cubic(1, left.coupling, left.coupling_by_elastic, right.coupling, right.coupling_by_elastic, t),
            (elastic_volumetric - ee) * elastic_per_spacing_, plastic_volumetric != ep};
  }

  std::vector<Node> nodes_;
  std::size_t n_elastic_ = 0;  // nodes a line
  double last_elastic_ = 0;
  double elastic_per_spacing_ = 0;  // spacings per unit of elastic strain
  std::vector<double> lines_per_strain_;
  double least_bulk_modulus_ = 0;

  std::optional<PressureModulus> pressure_modulus_;
};

}  // namespace tamp::components
