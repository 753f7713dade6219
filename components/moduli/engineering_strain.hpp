#pragma once

#include <algorithm>
#include <cmath>

#include "components/moduli/elastic_model.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

/// The logarithmic volumetric strain -ln(J) of an engineering one, 1 - J, and back. Compression positive.
inline double logarithmic_strain(double engineering)
{
  return -portable::log1p(-engineering);
}
inline double engineering_strain(double logarithmic)
{
  return -portable::expm1(-logarithmic);
}

/// A model that was fitted to engineering strains, asked in logarithmic ones. Total strain t = e + ep and plastic
/// strain ep are converted; the model's elastic strain is their difference.
template <ElasticModel Model>
class EngineeringStrain
{
 public:
  explicit EngineeringStrain(Model model) : model_(std::move(model)) {}

  ElasticPoint at(double elastic, double plastic) const { return point_at(elastic, plastic); }
  ElasticPointOf<Lanes> at(const Lanes& elastic, const Lanes& plastic) const { return point_at(elastic, plastic); }

  double rate_modulus(double pressure, double elastic, double plastic) const
  {
    return modulus_at(pressure, elastic, plastic);
  }
  Lanes rate_modulus(const Lanes& pressure, const Lanes& elastic, const Lanes& plastic) const
  {
    return modulus_at(pressure, elastic, plastic);
  }

  double modulus_by_plastic(double elastic, double plastic) const
  {
    // d/d(plastic) of K(m.elastic, m.plastic) total_rate; the model's dK/d(elastic) by a difference: for reports only.
    const Measured<double> m = measured(elastic, plastic);
    constexpr double h = 1e-6;
    const double by_elastic =
        (model_.at(m.elastic + h, m.plastic).bulk_modulus - model_.at(m.elastic - h, m.plastic).bulk_modulus) / (2 * h);
    const double along =
        by_elastic * (m.total_rate - m.plastic_rate) + model_.modulus_by_plastic(m.elastic, m.plastic) * m.plastic_rate;
    return (along - model_.at(m.elastic, m.plastic).bulk_modulus) * m.total_rate;
  }

  bool in_range(double elastic, double plastic) const
  {
    const Measured<double> m = measured(elastic, plastic);
    return model_.in_range(m.elastic, m.plastic);
  }

  bool rate_in_range(double pressure, double elastic, double plastic) const
  {
    const Measured<double> m = measured(elastic, plastic);
    return model_.rate_in_range(pressure, m.elastic, m.plastic);
  }

  /// Inside the model's: an elastic strain is longest in logarithms where there is plastic strain ahead of it.
  StrainRange range() const
  {
    const StrainRange own = model_.range();
    const double last = std::min(own.most_plastic, largest_engineering);
    const auto total = [&](double elastic, double plastic) { return logarithmic_strain(elastic + plastic); };
    return {total(own.least_elastic, own.least_plastic) - logarithmic_strain(own.least_plastic),
            total(own.most_elastic, own.least_plastic) - logarithmic_strain(own.least_plastic),
            logarithmic_strain(own.least_plastic), logarithmic_strain(last)};
  }

 private:
  static constexpr double largest_engineering = 0.95;

  template <class Number>
  struct Measured {
    Number elastic, plastic;          // engineering
    Number total_rate, plastic_rate;  // d(engineering) / d(logarithmic)
  };
  template <class Number>
  static Measured<Number> measured(const Number& elastic, const Number& plastic)
  {
    const Number total_rate = portable::exp(-(elastic + plastic)), plastic_rate = portable::exp(-plastic);
    return {plastic_rate - total_rate, 1 - plastic_rate, total_rate, plastic_rate};
  }

  template <class Number>
  ElasticPointOf<Number> point_at(const Number& elastic, const Number& plastic) const
  {
    const Measured<Number> m = measured(elastic, plastic);
    const ElasticPointOf<Number> point = model_.at(m.elastic, m.plastic);
    return {point.pressure, point.bulk_modulus * m.total_rate,
            point.bulk_modulus * (m.total_rate - m.plastic_rate) + point.coupling * m.plastic_rate};
  }
  template <class Number>
  Number modulus_at(const Number& pressure, const Number& elastic, const Number& plastic) const
  {
    const Measured<Number> m = measured(elastic, plastic);
    return model_.rate_modulus(pressure, m.elastic, m.plastic) * m.total_rate;
  }

  Model model_;
};

}  // namespace tamp::components
