#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "components/curves/monotone_cubic.hpp"
#include "components/lanes.hpp"
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
  static constexpr std::string_view type = "table";
  static constexpr std::string_view meaning = "measured unloading curves";
  static constexpr std::string_view file =
      "unloading curves with the columns `plastic_volumetric[-]`, `elastic_volumetric[-]`, `pressure[Pa]` or a "
      "published tabular JSON";
  static constexpr double compile_tolerance = 1e-4;

  /// The columns of unloading.csv: rows grouped by plastic strain (ascending, not negative), each curve starting at
  /// elastic strain 0 and pressure 0, both strictly increasing. Throws BadValue, with the row, for anything else, and
  /// for curves that cross (less total strain at equal pressure after more plastic strain).
  UnloadingTable(std::span<const double> plastic_volumetric, std::span<const double> elastic_volumetric,
                 std::span<const double> pressure);

  ElasticPoint at(double elastic_volumetric, double plastic_volumetric) const
  {
    return point_at(elastic_volumetric, plastic_volumetric);
  }
  ElasticPointOf<Lanes> at(const Lanes& elastic_volumetric, const Lanes& plastic_volumetric) const
  {
    return point_at(elastic_volumetric, plastic_volumetric);
  }

  double rate_modulus(double pressure, double /*elastic*/, double plastic_volumetric) const
  {
    return pressure_modulus()(pressure, plastic_volumetric);
  }
  Lanes rate_modulus(const Lanes& pressure, const Lanes& /*elastic*/, const Lanes& plastic_volumetric) const
  {
    return pressure_modulus()(pressure, plastic_volumetric);
  }
  const PressureModulus& pressure_modulus() const { return *pressure_modulus_; }

  double modulus_by_plastic(double elastic_volumetric, double plastic_volumetric) const
  {
    const Located<double> here = locate(elastic_volumetric, plastic_volumetric);
    return here.held ? 0 : here.coupling.slope * elastic_per_spacing_;
  }

  /// On or between the measured curves: not beyond their ends, and no more than 0.1 % in tension, which was not
  /// measured.
  bool in_range(double elastic_volumetric, double plastic_volumetric) const;
  bool rate_in_range(double pressure, double /*elastic*/, double plastic_volumetric) const
  {
    return pressure_modulus().in_range(pressure, plastic_volumetric);
  }
  Mask<Lanes> rate_in_range(const Lanes& pressure, const Lanes& /*elastic*/, const Lanes& plastic_volumetric) const
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
  void check_rises(std::span<const double> elastic, std::span<const double> pressures, double plastic) const;
  void find_least_bulk_modulus(std::span<const double> plastic_of_line);
  [[noreturn]] void refuse_between_curves(const std::string& found, double pressure, double plastic) const;

  /// Elastic strain at a pressure, and its derivatives, by the definition.
  struct StrainAtPressure {
    double elastic, by_plastic;
  };
  StrainAtPressure strain_at(double pressure, double plastic) const;

  static constexpr double least_elastic = -1e-3;

  // An entry for each curve, the first for plastic strain zero; curves are elastic strain of pressure.
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
  template <class Number>
  struct NodeOf {
    Number pressure, by_elastic, coupling, coupling_by_elastic;
  };
  using Node = NodeOf<double>;

  /// Interpolates nodes from one line to the next: cubic in the plastic strain, with the coupling as slope.
  template <class Number>
  struct Across {
    Number low, high, low_slope, high_slope;  // weights of values and couplings in a value
    Number change, low_change, high_change;   // weights in its derivative by plastic strain

    Across(const Number& t, const Number& lines_per_strain)
    {
      const Number s = 1 - t, spacing = 1 / lines_per_strain;
      high = t * t * (3 - 2 * t);
      low = 1 - high;
      low_slope = spacing * t * s * s;
      high_slope = -spacing * t * t * s;
      change = 6 * t * s * lines_per_strain;
      low_change = s * (1 - 3 * t);
      high_change = t * (3 * t - 2);
    }

    NodeOf<Number> operator()(const NodeOf<Number>& a, const NodeOf<Number>& b) const
    {
      return {low * a.pressure + high * b.pressure + low_slope * a.coupling + high_slope * b.coupling,
              low * a.by_elastic + high * b.by_elastic + low_slope * a.coupling_by_elastic +
                  high_slope * b.coupling_by_elastic,
              change * (b.pressure - a.pressure) + low_change * a.coupling + high_change * b.coupling,
              change * (b.by_elastic - a.by_elastic) + low_change * a.coupling_by_elastic +
                  high_change * b.coupling_by_elastic};
    }
  };

  /// The gap between two curves that holds a plastic strain, which is not below the first curve's.
  template <class Number>
  struct Gap {
    Number curve, start, lines_per_strain;
  };
  template <class Number>
  Gap<Number> gap_at(const Number& plastic) const
  {
    Number curve = 0.0, start = curve_plastic_[0], lines_per_strain = lines_per_strain_[0];
    for (std::size_t k = 1; k + 1 < curve_plastic_.size(); ++k) {
      const Mask<Number> there = plastic >= curve_plastic_[k];
      curve = select(there, Number(static_cast<double>(k)), curve);
      start = select(there, Number(curve_plastic_[k]), start);
      lines_per_strain = select(there, Number(lines_per_strain_[k]), lines_per_strain);
    }
    return {curve, start, lines_per_strain};
  }

  /// Cubics in the elastic strain, per spacing, at one plastic strain, which is `held` where it is outside the curves'.
  template <class Number>
  struct Located {
    CubicValueOf<Number> pressure, coupling;
    Number beyond;  // spacings outside the grid
    Mask<Number> held;
  };
  template <class Number>
  Located<Number> locate(const Number& elastic_volumetric, const Number& plastic_volumetric) const
  {
    // In this order a strain that is not a number counts as zero, and ends up in `beyond`.
    const Number ep = lesser_of<Number>(greater_of<Number>(0.0, plastic_volumetric), curve_plastic_.back());
    const Gap<Number> gap = gap_at(ep);
    const Number lines = (ep - gap.start) * gap.lines_per_strain;
    const Number line = lesser_of<Number>(truncated(lines), n_lines_a_curve - 1.0);

    const Number ee = lesser_of<Number>(greater_of<Number>(0.0, elastic_volumetric), last_elastic_);
    const Number cells = ee * elastic_per_spacing_;
    const Number cell = lesser_of<Number>(truncated(cells), last_cell_);

    const Number n_elastic = last_cell_ + 2;
    const auto first = whole_parts((gap.curve * static_cast<double>(n_lines_a_curve) + line) * n_elastic + cell);
    std::array<const double*, n_lanes_of<Number>> low, high;
    for (std::size_t l = 0; l < low.size(); ++l) {
      const Node* const node = &nodes_[static_cast<std::size_t>(first[l])];
      low[l] = &node->pressure;
      high[l] = &node[n_elastic_].pressure;
    }
    // Two nodes of each line, which follow on each other.
    const auto [a0, a1, a2, a3, b0, b1, b2, b3] = side_by_side<8>(low);
    const auto [c0, c1, c2, c3, d0, d1, d2, d3] = side_by_side<8>(high);
    const Across<Number> across(lines - line, gap.lines_per_strain);
    const NodeOf<Number> left = across({a0, a1, a2, a3}, {c0, c1, c2, c3});
    const NodeOf<Number> right = across({b0, b1, b2, b3}, {d0, d1, d2, d3});

    const Number t = cells - cell;
    return {cubic<Number>(1.0, left.pressure, left.by_elastic, right.pressure, right.by_elastic, t),
            cubic<Number>(1.0, left.coupling, left.coupling_by_elastic, right.coupling, right.coupling_by_elastic, t),
            (elastic_volumetric - ee) * elastic_per_spacing_, plastic_volumetric != ep};
  }

  template <class Number>
  ElasticPointOf<Number> point_at(const Number& elastic_volumetric, const Number& plastic_volumetric) const
  {
    const auto [p, c, beyond, held] = locate(elastic_volumetric, plastic_volumetric);
    // `beyond` is not zero in tension and beyond the grid's end: straight on.
    const Number coupling = c.value + c.slope * beyond;
    return {p.value + p.slope * beyond, p.slope * elastic_per_spacing_, select(held, Number(0.0), coupling)};
  }

  std::vector<Node> nodes_;
  std::size_t n_elastic_ = 0;  // nodes a line
  double last_cell_ = 0;       // from one of them to the next, counted from zero
  double last_elastic_ = 0;
  double elastic_per_spacing_ = 0;  // spacings per unit of elastic strain
  std::vector<double> lines_per_strain_;
  double least_bulk_modulus_ = 0;

  std::optional<PressureModulus> pressure_modulus_;
};

}  // namespace tamp::components
