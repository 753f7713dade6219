#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "components/kinematics/deformation_update.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Particles that a step deforms; all spans have one length.
template <int D>
struct DeformedParticles {
  /// dt times the velocity gradient at the middle of the step; row: component of velocity.
  std::span<const Matrix<D>> g;
  std::span<const Matrix<D>> old_gradient;
  std::span<const double> old_volume;
  std::span<const SymmetricTensor<D>> old_stress;
  /// Results of these, see StrainIncrement.
  std::span<Matrix<D>> deformation_gradient;
  std::span<double> volume;
  /// The stress at the start of the step, turned with the particle.
  std::span<SymmetricTensor<D>> stress;
  std::span<SymmetricTensor<D>> strain_increment;
};

/// Deforms particles by one of the updates, as many at once as the processor has lanes, and one by one where lanes will
/// not do; gives the first whose step is not admissible. What a particle gets does not depend on those around it.
template <int D>
std::optional<std::size_t> deform(DeformationUpdate update, const DeformedParticles<D>& particles);

/// The hoops of particles that are rings, which a step stretches; all spans have one length.
struct StretchedHoops {
  /// dt v_r / r at the middle of the step.
  std::span<const double> g;
  std::span<const double> old_stretch;
  std::span<double> stretch;
  /// Volumes and strain increments as `deform` leaves them; the hoops add their part.
  std::span<double> volume;
  std::span<SymmetricTensor<2>> strain_increment;
};

/// Stretches the hoops of particles that `deform` has deformed in the plane; gives the first that cannot follow. The
/// axis of a hoop is the principal one across the plane, so that the strain zz is a number of its own.
std::optional<std::size_t> stretch_hoops(DeformationUpdate update, const StretchedHoops& hoops);

}  // namespace tamp::components
