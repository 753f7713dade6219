#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "components/moduli/elastic_model.hpp"
#include "components/moduli/hermite_surface.hpp"
#include "components/moduli/pressure_modulus.hpp"
#include "components/moduli/range_mask.hpp"

namespace tamp::components
{

/// An elastic model compiled: its pressure surface over its range resampled to bicubic patches, with a certificate of
/// how far they are from it. Every compiled model costs the same, whatever it was.
///
/// The rate form takes K at the strains from the surface, or by the model's own function of pressure if that is what it
/// takes K by. The model's word on what is in range is kept to 1/256 of the range; beyond the range nothing is.
class ModulusSurface
{
 public:
  /// p and K within `tolerance` of the model's (see SurfaceTolerance). Throws BadValue if that takes too many patches.
  template <ElasticModel Model>
  ModulusSurface(const Model& model, double tolerance)
      : tolerance_(tolerance),
        surface_(model.range(), line_of(model), {tolerance, tolerance}, seams_of(model)),
        in_range_(model.range(), [&](double elastic, double plastic) { return model.in_range(elastic, plastic); })
  {
    if constexpr (takes_pressure<Model>) pressure_modulus_ = model.pressure_modulus();
  }

  ElasticPoint at(double elastic, double plastic) const { return surface_.at(elastic, plastic); }
  ElasticPointOf<Lanes> at(const Lanes& elastic, const Lanes& plastic) const { return surface_.at(elastic, plastic); }
  double rate_modulus(double pressure, double elastic, double plastic) const
  {
    if (pressure_modulus_) return (*pressure_modulus_)(pressure, plastic);
    return surface_.at(elastic, plastic).bulk_modulus;
  }
  Lanes rate_modulus(const Lanes& pressure, const Lanes& elastic, const Lanes& plastic) const
  {
    if (pressure_modulus_) return (*pressure_modulus_)(pressure, plastic);
    return surface_.at(elastic, plastic).bulk_modulus;
  }
  double modulus_by_plastic(double elastic, double plastic) const
  {
    return surface_.modulus_by_plastic(elastic, plastic);
  }
  bool in_range(double elastic, double plastic) const { return in_range_(elastic, plastic); }
  bool rate_in_range(double pressure, double elastic, double plastic) const
  {
    return pressure_modulus_ ? pressure_modulus_->in_range(pressure, plastic) : in_range(elastic, plastic);
  }
  StrainRange range() const { return surface_.range(); }

  double tolerance() const { return tolerance_; }
  const SurfaceErrors& errors() const { return surface_.errors(); }

 private:
  template <class Model>
  static constexpr bool takes_pressure = requires(const Model& model)
  {
    model.pressure_modulus();
  };

  /// A model whose pressure is an integral gives it along a line better than state by state: small patches would take
  /// what its own table of the integral is off for a modulus.
  template <class Model>
  static SurfaceLine line_of(const Model& model)
  {
    return [&model](double plastic, std::span<const double> elastic, std::span<SurfaceNode> nodes) {
      if constexpr (requires { model.on_line(plastic, elastic, nodes); }) {
        model.on_line(plastic, elastic, nodes);
        return;
      }
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto [pressure, bulk_modulus, coupling] = model.at(elastic[i], plastic);
        nodes[i] = {pressure, bulk_modulus, coupling, model.modulus_by_plastic(elastic[i], plastic)};
      }
    };
  }

  /// A table's curves; its surface is smooth between them.
  template <class Model>
  static SurfaceSeams seams_of([[maybe_unused]] const Model& model)
  {
    if constexpr (requires { model.curve_plastic(); }) {
      return {{}, {model.curve_plastic().begin(), model.curve_plastic().end()}};
    } else {
      return {};
    }
  }

  double tolerance_;
  HermiteSurface surface_;
  std::optional<PressureModulus> pressure_modulus_;
  RangeMask in_range_;
};

}  // namespace tamp::components
