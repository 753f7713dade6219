#pragma once

#include <span>

#include "components/kinematics/deformation_update.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The change of volume det f - 1 of each particle by g, dt times its velocity gradient.
template <int D>
void volume_changes(DeformationUpdate update, std::span<const Matrix<D>> g, std::span<double> change);

/// Replaces them: f keeps its shape and gets the determinant 1 + change, f_bar = ((1 + change) / det f)^(1/D) f; in
/// plane strain nothing changes out of the plane. A particle that is turned inside out stays so.
template <int D>
void set_volume_changes(DeformationUpdate update, std::span<Matrix<D>> g, std::span<const double> change);

/// The same of particles that are rings, whose hoops a step stretches by `hoop`, dt v_r / r: a ring changes its volume
/// as a particle in space whose gradient has the hoop's across the plane, and all three of its stretches are scaled.
void ring_volume_changes(DeformationUpdate update, std::span<const Matrix<2>> g, std::span<const double> hoop,
                         std::span<double> change);
void set_ring_volume_changes(DeformationUpdate update, std::span<Matrix<2>> g, std::span<double> hoop,
                             std::span<const double> change);

}  // namespace tamp::components
