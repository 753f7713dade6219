#pragma once

#include <string_view>
#include <vector>

#include "components/moduli/elastic_model.hpp"
#include "components/moduli/gaussian_sum.hpp"
#include "components/moduli/support_vector_fit.hpp"

namespace tamp::components
{

/// Where the pressure of a support-vector fit is zero.
enum class ZeroPressure {
  as_fitted,              ///< where the fit has it: what the file says
  at_zero_elastic_strain  ///< p(elastic, plastic) - p(0, plastic), with the same K: what a material needs
};

/// Elasticity by a support-vector regression of pressure over total and plastic volumetric strain, with a Gaussian
/// kernel: the report's SVR model (Banerjee, Brannon, Fox, Regueiro 2021, PAR-10021867-092020-6), exact to round-off at
/// a cost that does not depend on the number of vectors. K is its analytic derivative; the rate form takes it at the
/// strains. Volumetric strains are logarithmic and compression positive.
///
/// A fit is trusted within its box (lower to upper of both strains) and, from elastic strain zero outwards, as far as K
/// stays above a twentieth of K at elastic strain zero, since the published fit softens to K < 0 in tension. Beyond,
/// the pressure goes straight on in elastic strain with the modulus at that edge; the edge in total strain is a
/// broken line over plastic strain, on the safe side. Plastic strain outside the box is held at its end, and negative
/// plastic strain counts as zero.
class SupportVectorModulus
{
 public:
  static constexpr std::string_view type = "svr";
  static constexpr std::string_view meaning = "support-vector regression of the pressure";
  static constexpr std::string_view file = "a published SVR JSON";
  static constexpr double compile_tolerance = 1e-4;

  /// Throws BadValue for a fit that is not finite, without vectors, or with other than one coefficient each, for scales
  /// and widths that are not positive, for a kernel that fits more than 20 times into the box, for a box without states
  /// of elastic strain zero, and where K is not positive at elastic strain zero.
  SupportVectorModulus(const SupportVectorFit& fit, ZeroPressure zero);

  ElasticPoint at(double elastic, double plastic) const;
  ElasticPointOf<Lanes> at(const Lanes& elastic, const Lanes& plastic) const;
  double rate_modulus(double pressure, double elastic, double plastic) const;
  Lanes rate_modulus(const Lanes& pressure, const Lanes& elastic, const Lanes& plastic) const;
  double modulus_by_plastic(double elastic, double plastic) const;
  bool in_range(double elastic, double plastic) const;
  bool rate_in_range(double /*pressure*/, double elastic, double plastic) const { return in_range(elastic, plastic); }

  /// The elastic strains that are trusted at every plastic strain of the box.
  StrainRange range() const { return range_; }

 private:
  /// The trusted state for a given one.
  template <class Number>
  struct Place {
    Number total, plastic;
    Number beyond;            // the elastic strain that is left over
    Number total_by_plastic;  // as the plastic strain changes at equal elastic strain
    Mask<Number> held;        // in plastic strain
  };

  template <class Number>
  Place<Number> place_of(const Number& elastic, const Number& plastic) const;
  template <class Number>
  ElasticPointOf<Number> point_at(const Number& elastic, const Number& plastic) const;
  template <class Number>
  Number modulus_at(const Number& elastic, const Number& plastic) const;
  void find_trusted(Interval total);
  double trusted_end(double plastic, double box_end) const;

  GaussianSum pressure_;           // of total and plastic strain
  std::vector<Interval> trusted_;  // total strains, at plastic strains evenly spaced over the box
  double nodes_per_strain_ = 0;
  StrainRange range_{};
};

}  // namespace tamp::components
