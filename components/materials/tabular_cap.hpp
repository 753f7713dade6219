#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "components/curves/piecewise_linear.hpp"
#include "components/errors.hpp"
#include "components/materials/crush_curve.hpp"
#include "components/materials/material_batch.hpp"
#include "components/materials/settled_start.hpp"
#include "components/materials/state_columns.hpp"
#include "components/materials/yield_surface.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Sand: pressure-dependent elasticity from a modulus model, and associated plasticity with a tabulated yield surface
/// closed by a cap that hardens with plastic volumetric strain (Banerjee, Brannon, Fox, Regueiro 2021,
/// PAR-10021867-092020-6). Volumetric strains, pressures and the cap are compression positive; tensors are tension
/// positive. SI units.

/// How pressure follows from strain. `state`: p = p(elastic, plastic), a function of the state. `rate`:
/// dp = K d(elastic), as published, which loses the pressure that goes with a change of plastic strain.
enum class ElasticUpdate { rate, state };

struct CapState {
  double elastic_volumetric = 0;  ///< compression positive
  double plastic_volumetric = 0;  ///< compression positive
  double equivalent_plastic = 0;  ///< sum of sqrt(2/3 de:de), e the plastic strain's deviator
  double bulk_modulus = 0;        ///< modulus after the last update [Pa]; 0 before the first and where it is apart
  std::int32_t n_failures = 0;    ///< updates that failed, and left stress and strains as they were
  /// Volume at which it separated, over that at the start; 0 while it is whole. Not a double, so that a state takes no
  /// more than 40 bytes.
  /// more than 40 bytes.
  float separation_volume = 0;
};

struct TabularCapParameters {
  /// Keeps depths, peaks and energies of a punch within 0.03 %, see docs/findings/how_tight_a_stress_tolerance.md.
  static constexpr double usual_tolerance = 1e-4;
  static constexpr int usual_max_substeps = 100;
  static constexpr double usual_separation_density = 0.8;

  double poisson_ratio;
  ElasticUpdate elastic_update;
  Modulus modulus;
  PiecewiseLinear crush_curve;  ///< X(plastic volumetric strain); in state form, that of consistent_crush_curve
  YieldSurface yield;
  double tolerance = usual_tolerance;  ///< relative error of the stress in one step; sets the number of substeps
  int max_substeps = usual_max_substeps;
  /// Part of the initial density below which sand at the tension vertex separates, see separation.hpp; without it, it
  /// never does.
  std::optional<double> separation_density{};
  /// Plastic volumetric expansion since the start beyond which shear changes the volume of the sand no more; without
  /// it, flow stays associated however loose the sand is, as published.
  std::optional<double> dilation_limit{};
  /// Whether sand that is torn separates at any density, and what it is stretched by while it is torn is a gap, see
  /// Gaps, and no plastic volume.
  bool gaps = false;
};

class TabularCap
{
 public:
  using State = CapState;
  static constexpr std::string_view type = "tabular_cap";
  static constexpr bool is_soil = true;
  static constexpr char state_name[] = "cap state";
  /// Strains, the crush pressure X "cap", the tangent bulk modulus "K", failed updates, whether it has separated; of a
  /// single point also whether the elastic model was asked within its range, and how far the stress is outside of the
  /// yield surface, over the length of that, crush pressure less tension vertex.
  static std::span<const StateColumn<TabularCap>, 8> columns();
  static std::span<const StateExtreme, 3> extremes();

  /// Throws BadValue for a Poisson's ratio outside (-1, 0.5), or a crush curve that falls or starts at or below zero.
  explicit TabularCap(TabularCapParameters parameters);

  const TabularCapParameters& parameters() const { return parameters_; }
  double poisson_ratio() const { return parameters_.poisson_ratio; }

  bool may_separate() const { return parameters_.separation_density.has_value() || parameters_.gaps; }
  bool keeps_gaps() const { return parameters_.gaps; }

  /// G / K.
  double shear_ratio() const { return shear_ratio_; }

  /// X, the hydrostatic strength after this plastic volumetric strain.
  double crush_pressure(double plastic_volumetric) const;

  /// Tangent bulk modulus of a state; `pressure` is read in rate form only.
  double bulk_modulus(const CapState& state, double pressure) const;
  TangentModuli initial_moduli() const;

  /// Whether a state under `pressure` is within the tested range.
  Tested tested(const CapState& state, double pressure) const;

  /// Sand with less plastic volumetric strain is looser than any that was tested.
  double least_plastic() const { return least_plastic_; }

  /// The pressure that the state form gives a state: what the stress of a particle must have before its first update.
  double pressure(const CapState& state) const;

  /// A state with this pressure after this plastic strain. The plastic strain must make the crush pressure suffice.
  CapState state_at_pressure(double pressure, double plastic_volumetric) const;

  /// The least plastic volumetric strain whose crush pressure is `pressure` (0 where less than any): what a sand has
  /// that was loaded to it.
  double plastic_volumetric_at_crush(double pressure) const;

  /// The state of sand which was loaded to the greatest pressure on it, and not more: that is the crush pressure at
  /// least. Throws BadValue for a stress outside of the yield surface.
  State settled_state(const SettledStress& settled) const;

 private:
  TabularCapParameters parameters_;
  double shear_ratio_;
  double least_plastic_;
};

/// Advances each particle of a batch by its strain increment.
///  - In state form the mean of the old stress must be that of the old state.
///  - The bulk modulus is the tangent: in state form of the new state, in rate form of the last substep's middle.
/// A large increment is cut into substeps so that the estimated stress error stays within the tolerance; none is
/// smaller than the increment over `max_substeps`, and one of that size is taken whatever its error, and counted. An
/// increment larger than 0.2 is refused. A particle that cannot be updated keeps its stress and strains, and is marked
/// in its state and counted; the answer is the first of them. `counts` is added to. Deformation gradients are looked at
/// only of sand that may separate: while it is, stress and moduli are zero.
template <int D>
BatchFailure update(const TabularCap& sand, const MaterialBatch<D, CapState>& batch, UpdateCounts& counts);

}  // namespace tamp::components
