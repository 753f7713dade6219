#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "components/materials/material_batch.hpp"
#include "components/tensors.hpp"

/// Hyperelastic solids in axisymmetric scenes, whose particles are rings: they answer as in space, to a deformation
/// gradient that has the stretch of the hoop across the plane.
namespace tamp::components
{

inline Matrix<3> with_hoop(const Matrix<2>& in_plane, double hoop_stretch)
{
  Matrix<3> f = Matrix<3>::Zero();
  f.topLeftCorner<2, 2>() = in_plane;
  f(2, 2) = hoop_stretch;
  return f;
}

/// The answer of a solid to a batch of rings of the plane.
template <Hyperelastic Model>
BatchFailure update_rings(const Model& model, const MaterialBatch<2, NoState>& batch, UpdateCounts& counts)
{
  constexpr std::size_t n_at_once = 32;
  std::array<Matrix<3>, n_at_once> gradients;
  std::array<SymmetricTensor<3>, n_at_once> stresses;
  for (std::size_t first = 0; first < batch.stress.size(); first += n_at_once) {
    const std::size_t n = std::min(n_at_once, batch.stress.size() - first);
    for (std::size_t i = 0; i < n; ++i) {
      gradients[i] = with_hoop(batch.deformation_gradient[first + i], batch.hoop_stretch[first + i]);
    }
    const auto failure = update(model,
                                MaterialBatch<3, NoState>{.strain_increment = {},
                                                          .deformation_gradient = std::span(gradients).first(n),
                                                          .old_state = {},
                                                          .stress = std::span(stresses).first(n),
                                                          .state = {},
                                                          .bulk_modulus = batch.bulk_modulus.subspan(first, n),
                                                          .shear_modulus = batch.shear_modulus.subspan(first, n),
                                                          .plastic_work = batch.plastic_work.subspan(first, n)},
                                counts);
    if (failure) return UpdateFailure{first + failure->particle, failure->fault};
    for (std::size_t i = 0; i < n; ++i) batch.stress[first + i] = stresses[i].template head<n_symmetric<2>>();
  }
  return {};
}

}  // namespace tamp::components
