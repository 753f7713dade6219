#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "components/materials/monotone_cubic.hpp"

namespace tamp::components
{

/// What an elastic model says of one state. Pascal; compression positive.
struct ElasticPoint {
  double pressure;
  double bulk_modulus;  ///< d pressure / d elastic volumetric strain
  double coupling;      ///< d pressure / d plastic volumetric strain, at the same elastic strain
};

/// Pressure and bulk modulus of a sand from its measured unloading curves, each of which starts from its own plastic
/// strain. All strains are volumetric; strains and pressures are compression positive.
///
/// Two readings of the same curves:
///  - state form, `at`: pressure is a surface p(elastic, plastic). Between curves the TOTAL strain at equal pressure is
///    interpolated in the plastic strain by a monotone cubic. Total strain then always rises with plastic strain at
///    equal pressure, that is, bulk_modulus > coupling, so plastic compaction at fixed total strain always relieves
///    pressure, and a return mapping has one answer.
///  - rate form, `bulk_modulus_at_pressure`: bulk modulus as a function of pressure along each curve, constant beyond
///    the curve's ends, linear in plastic strain between curves: the report's Table model (Banerjee, Brannon, Fox,
///    Regueiro 2021, PAR-10021867-092020-6).
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

  /// State form, for one state.
  ElasticPoint at(double elastic_volumetric, double plastic_volumetric) const
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
    const CubicValue p = cubic(1, left.pressure, left.by_elastic, right.pressure, right.by_elastic, t);
    const CubicValue c =
        cubic(1, left.coupling, left.coupling_by_elastic, right.coupling, right.coupling_by_elastic, t);
    // Not zero in tension and beyond the grid's end: straight on.
    const double beyond = (elastic_volumetric - ee) * elastic_per_spacing_;
    const bool held = plastic_volumetric != ep;
    return {p.value + p.slope * beyond, p.slope * elastic_per_spacing_, held ? 0 : c.value + c.slope * beyond};
  }

  /// State form, for a batch: spans of equal length.
  void at(std::span<const double> elastic_volumetric, std::span<const double> plastic_volumetric,
          std::span<ElasticPoint> points) const;

  /// Rate form, for one state.
  double bulk_modulus_at_pressure(double pressure, double plastic_volumetric) const
  {
    const double shifted = std::min(std::max(pressure, 0.0), last_pressure_) + pressure_shift_;
    const OctaveCell cell = octave_cell(shifted);
    const double ep = std::min(std::max(plastic_volumetric, 0.0), curve_plastic_.back());
    const std::size_t k = curve_below(ep);
    const double s = (ep - curve_plastic_[k]) * lines_per_strain_[k] * (1.0 / n_lines_a_curve);

    const std::size_t n_curves = curve_plastic_.size();
    const double* const low = &modulus_[(cell.number - first_octave_cell_) * n_curves + k];
    const double* const high = low + n_curves;
    const double at_low = low[0] + s * (low[1] - low[0]), at_high = high[0] + s * (high[1] - high[0]);
    return at_low + cell.fraction * (at_high - at_low);
  }

  /// Rate form, for a batch: spans of equal length.
  void bulk_modulus_at_pressure(std::span<const double> pressure, std::span<const double> plastic_volumetric,
                                std::span<double> bulk_modulus) const;

  /// The elastic strain at which the state form has this pressure.
  double elastic_volumetric_at(double pressure, double plastic_volumetric) const;

  /// The smallest modulus of the surface, from the grid's nodes and half way between them; positive.
  double least_bulk_modulus() const { return least_bulk_modulus_; }
  double last_plastic_volumetric() const { return curve_plastic_.back(); }
  double last_elastic_volumetric() const { return last_elastic_; }

  /// The surface by its definition, without the grid: slow, and the reference that tests compare `at` with.
  ElasticPoint defined_at(double elastic_volumetric, double plastic_volumetric) const;

 private:
  void read_curves(std::span<const double> plastic, std::span<const double> elastic, std::span<const double> pressure);
  void extend_curves();
  void check_curves_do_not_cross() const;
  void make_surface_grid();
  void make_modulus_grid();

  /// Elastic strain at a pressure, and its derivatives, by the definition.
  struct StrainAtPressure {
    double elastic, by_plastic;
  };
  StrainAtPressure strain_at(double pressure, double plastic) const;
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
  std::vector<Node> nodes_;
  std::size_t n_elastic_ = 0;  // nodes a line
  double last_elastic_ = 0;
  double elastic_per_spacing_ = 0;  // spacings per unit of elastic strain
  std::vector<double> lines_per_strain_;
  double least_bulk_modulus_ = 0;

  // Rate form: [pressure node][curve], pressure nodes evenly spaced in each octave of (pressure + shift): the leading
  // bits of that number are the cell, the others the place in it.
  static constexpr int octave_bits = 6;  // 64 cells in each octave
  static constexpr int place_bits = 52 - octave_bits;
  struct OctaveCell {
    std::size_t number;
    double fraction;
  };
  static OctaveCell octave_cell(double shifted_pressure)
  {
    const auto bits = std::bit_cast<std::uint64_t>(shifted_pressure);
    const std::uint64_t place = bits & ((std::uint64_t{1} << place_bits) - 1);
    return {static_cast<std::size_t>(bits >> place_bits),
            static_cast<double>(place) * (1.0 / static_cast<double>(std::uint64_t{1} << place_bits))};
  }
  std::vector<double> modulus_;
  double pressure_shift_ = 0;
  std::size_t first_octave_cell_ = 0;
};

}  // namespace tamp::components
