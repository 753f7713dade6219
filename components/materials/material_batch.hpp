#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>

#include "components/errors.hpp"
#include "components/numbers.hpp"
#include "components/tensors.hpp"

/// Requirements of a material model:
///
///  - `State`, what a particle keeps from step to step beside its stress, or NoState;
///  - `type`, its name in scenes;
///  - `parameters()`, the numbers that a scene gives it, and `check()` where they have to agree, see parameter.hpp;
///    or a `read_model` of its own in tools/scene/materials/read_material.cpp;
///  - `initial_moduli()`, K and G without strain;
///  - `update(model, batch, counts)`, which answers a batch of particles;
///  - where it may lose all stiffness, `may_separate()`, and where it then keeps gaps, see Gaps, `keeps_gaps()`;
///  - where it is soil, `is_soil`;
///  - with a state, `state_name`, and `columns()` and `extremes()`, what output shows of it, see state_columns.hpp;
///  - where the stress follows from the deformation gradient alone, `stored_energy<D>(deformation_gradient)`;
///  - where bodies may start settled, `poisson_ratio()` and `settled_state(stress)`, see settled_start.hpp.
///
/// A model stands in the list of material_model.hpp; the tasks and tools loop over that.
namespace tamp::components
{

/// The state of a model that needs nothing besides stress and deformation.
struct NoState {
};

template <class Model>
inline constexpr bool has_state = !std::is_same_v<typename Model::State, NoState>;

/// Models whose stress follows from the deformation gradient alone: their bodies may start deformed.
template <class Model>
concept Hyperelastic = requires(const Model& model, const Matrix<3>& f)
{
  model.template stored_energy<3>(f);
};

/// Whether a model keeps gaps between its grains.
template <class Model>
bool keeps_gaps(const Model& model)
{
  if constexpr (requires { model.keeps_gaps(); }) return model.keeps_gaps();
  return false;
}

/// Sand, clay and the like.
template <class Model>
concept Soil = requires
{
  Model::is_soil;
};

/// Where a state in compression lies relative to the range that a model was made for: `looser` has less plastic
/// volumetric strain than any tested sand, as after dilation; `beyond` is past the largest strain or pressure. In
/// tension sand has next to no stress, and lies `within`.
enum class Tested { within, looser, beyond };

/// Elastic moduli [Pa], of one state or of as many as there are lanes.
template <class Number>
struct ModuliOf {
  Number bulk_modulus;
  Number shear_modulus;

  Number youngs_modulus() const { return 9 * bulk_modulus * shear_modulus / (3 * bulk_modulus + shear_modulus); }
  Number poisson_ratio() const
  {
    return (3 * bulk_modulus - 2 * shear_modulus) / (2 * (3 * bulk_modulus + shear_modulus));
  }
};
using TangentModuli = ModuliOf<double>;

/// Particles of a model for one step, in the frame that turns with the material, tension positive: spans of equal
/// length, those of states empty where the model has none.
template <int D, class State>
struct MaterialBatch {
  std::span<const SymmetricTensor<D>> strain_increment;
  /// Deformation gradient at the end of the step, in the axes of space.
  std::span<const Matrix<D>> deformation_gradient;
  std::span<const State> old_state;

  /// The old stress, turned to the frame of the step's end; the update makes it the new one.
  std::span<SymmetricTensor<D>> stress;
  /// State at the end of the step; may be the same memory as `old_state`.
  std::span<State> state;
  /// Moduli for waves at the end of the step [Pa]; zero where the material has separated.
  std::span<double> bulk_modulus;
  std::span<double> shear_modulus;
  /// Work on the step's plastic strain [J per m3 of current volume], not negative.
  std::span<double> plastic_work;
  /// Hoop stretch of rings about the axis, which the deformation gradient in the plane does not have; empty elsewhere.
  std::span<const double> hoop_stretch{};
  /// Gaps between the grains of soil whose grains may part, as a volumetric strain; `opening` may be the same memory as
  /// `old_opening`. Both are empty for other materials.
  std::span<const double> old_opening{};
  std::span<double> opening{};
};

/// Cost of batches, and counts of exceptional updates in them.
struct UpdateCounts {
  std::size_t substeps = 0;             ///< substeps taken; a whole increment counts as one
  std::size_t split_updates = 0;        ///< updates that took more than one substep
  std::size_t limited_substeps = 0;     ///< substeps accepted with an estimated error beyond the tolerance
  std::size_t modulus_evaluations = 0;  ///< evaluations of the elastic model
  std::size_t with_range = 0;           ///< updates by a model that is made for a range of strains or pressures
  std::size_t extrapolated = 0;         ///< updates of these that ended outside that range
  std::size_t pulled_out = 0;           ///< updates of those in tension, where sand has next to no stress
  std::size_t looser = 0;               ///< updates of the other extrapolated ones, looser than any test
  std::size_t failures = 0;             ///< updates that found no stress
  std::size_t separations = 0;          ///< particles that came apart
  std::size_t apart = 0;                ///< updates of particles that were apart and stay so, which are no work

  static constexpr auto fields = std::tuple{&UpdateCounts::substeps,
                                            &UpdateCounts::split_updates,
                                            &UpdateCounts::limited_substeps,
                                            &UpdateCounts::modulus_evaluations,
                                            &UpdateCounts::with_range,
                                            &UpdateCounts::extrapolated,
                                            &UpdateCounts::pulled_out,
                                            &UpdateCounts::looser,
                                            &UpdateCounts::failures,
                                            &UpdateCounts::separations,
                                            &UpdateCounts::apart};

  void add(const UpdateCounts& other)
  {
    for_each_number([](std::size_t& sum, std::size_t part) { sum += part; }, *this, other);
  }
};

/// The first particle of a batch that could not be updated, if any. Such particles keep their stress.
using BatchFailure = std::optional<UpdateFailure>;

}  // namespace tamp::components
