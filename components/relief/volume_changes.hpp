#pragma once

#include <cstddef>
#include <span>

#include "components/kinematics/deformation_update.hpp"
#include "components/tensor_lanes.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Of each particle the change of volume det f - 1 that g, dt times its velocity gradient, makes of it.
template <int D>
[[gnu::flatten]] void volume_changes(DeformationUpdate update, std::span<const Matrix<D>> g, std::span<double> change)
{
  with_update(update, [&]<class Update>(const Update&) {
    for (std::size_t p = 0; p < g.size(); p += n_lanes) {
      set_lanes(change, p, Update::template volume_change<D, Lanes>(lanes_at(g, p)));
    }
  });
}

/// Replaces them: f keeps its shape and gets the determinant 1 + change, f_bar = ((1 + change) / det f)^(1/D) f; in
/// plane strain nothing changes out of the plane. A particle that is turned inside out stays so.
template <int D>
[[gnu::flatten]] void set_volume_changes(DeformationUpdate update, std::span<Matrix<D>> g,
                                         std::span<const double> change)
{
  with_update(update, [&]<class Update>(const Update&) {
    for (std::size_t p = 0; p < g.size(); p += n_lanes) {
      set_lanes(g, p, Update::template with_volume_change<D, Lanes>(lanes_at(g, p), lanes_at(change, p)));
    }
  });
}

}  // namespace tamp::components
