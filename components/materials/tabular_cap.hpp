#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "components/errors.hpp"
#include "components/materials/crush_curve.hpp"
#include "components/materials/piecewise_linear.hpp"
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
  double bulk_modulus = 0;        ///< that the last update ended with; 0 before the first
  std::int64_t n_failures = 0;    ///< updates that failed, and left stress and strains as they were
};

struct TabularCapParameters {
  double poisson_ratio;
  ElasticUpdate elastic_update;
  Modulus modulus;
  PiecewiseLinear crush_curve;  ///< X(plastic volumetric strain); in state form, that of consistent_crush_curve
  YieldSurface yield;
  double tolerance = 1e-5;  ///< of the stress in one step, relative: sets the number of substeps
  int max_substeps = 100;
};

class TabularCap
{
 public:
  /// Throws BadValue for a Poisson's ratio outside (-1, 0.5), or a crush curve that falls or starts at or below zero.
  explicit TabularCap(TabularCapParameters parameters);

  const TabularCapParameters& parameters() const { return parameters_; }
  double poisson_ratio() const { return parameters_.poisson_ratio; }

  /// G / K.
  double shear_ratio() const { return shear_ratio_; }

  /// X, the hydrostatic strength after this plastic volumetric strain.
  double crush_pressure(double plastic_volumetric) const;

  /// Tangent bulk modulus of a state; `pressure` is read in rate form only.
  double bulk_modulus(const CapState& state, double pressure) const;
  double initial_bulk_modulus() const { return bulk_modulus({}, 0); }
  double initial_shear_modulus() const { return shear_ratio_ * initial_bulk_modulus(); }

  /// The pressure that the state form gives a state: what the stress of a particle must have before its first update.
  double pressure(const CapState& state) const;

  /// A state with this pressure after this plastic strain. The plastic strain must make the crush pressure suffice.
  CapState state_at_pressure(double pressure, double plastic_volumetric) const;

  /// The least plastic volumetric strain whose crush pressure is `pressure` (0 where less than any): what a sand has
  /// that was loaded to it.
  double plastic_volumetric_at_crush(double pressure) const;

 private:
  TabularCapParameters parameters_;
  double shear_ratio_;
};

/// What a batch has cost, and what was out of the ordinary in it.
struct UpdateCounts {
  std::size_t substeps = 0;             ///< taken, a whole increment counting as one
  std::size_t split_updates = 0;        ///< that took more than one substep
  std::size_t limited_substeps = 0;     ///< accepted with an estimated error beyond the tolerance
  std::size_t modulus_evaluations = 0;  ///< of the elastic model
  std::size_t extrapolated = 0;         ///< updates that ended outside the range that the elastic model was made for
  std::size_t failures = 0;             ///< updates that found no stress

  void add(const UpdateCounts& other)
  {
    substeps += other.substeps;
    split_updates += other.split_updates;
    limited_substeps += other.limited_substeps;
    modulus_evaluations += other.modulus_evaluations;
    extrapolated += other.extrapolated;
    failures += other.failures;
  }
};

/// Advances a batch of particles by one strain increment each (spans of equal length, all in the frame that turns with
/// the material).
///  - `stress` holds the old stress, already rotated to the end-of-step frame, and is replaced by the new. In state
///    form its mean must be that of the old state.
///  - `state` receives the new states; it may be the same memory as `state_old`.
///  - `bulk_modulus` receives the tangent: in state form of the new state, in rate form of the last substep's middle.
///  - `plastic_work` receives the work on the step's plastic strain, J per m3 of current volume; it is not negative.
/// A large increment is cut into substeps so that the estimated stress error stays within the tolerance; none is
/// smaller than the increment over `max_substeps`, and one of that size is taken whatever its error, and counted. An
/// increment larger than 0.2 is refused. A particle that cannot be updated keeps its stress and strains, and is marked
/// in its state and counted; the answer is the first of them. `counts` is added to.
template <int D>
std::optional<UpdateFailure> update(const TabularCap& sand, std::span<const SymmetricTensor<D>> strain_increment,
                                    std::span<const CapState> state_old, std::span<SymmetricTensor<D>> stress,
                                    std::span<CapState> state, std::span<double> bulk_modulus,
                                    std::span<double> plastic_work, UpdateCounts& counts);

}  // namespace tamp::components
