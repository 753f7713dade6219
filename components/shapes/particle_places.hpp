#pragma once

#include <cstddef>
#include <span>

#include "components/tensors.hpp"

namespace tamp::components
{

/// Where particles are, and how they are deformed: what the weights of nodes follow from. Both spans have one length;
/// interpolators of particles of constant size leave the second alone.
template <int D>
struct ParticlePlaces {
  std::span<const Vector<D>> position;  ///< m
  std::span<const Matrix<D>> deformation_gradient = {};

  std::size_t size() const { return position.size(); }
  ParticlePlaces subspan(std::size_t first, std::size_t n) const
  {
    if (deformation_gradient.empty()) return {position.subspan(first, n)};
    return {position.subspan(first, n), deformation_gradient.subspan(first, n)};
  }
};

}  // namespace tamp::components
