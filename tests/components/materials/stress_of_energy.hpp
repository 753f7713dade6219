#pragma once

#include "components/tensors.hpp"

namespace tamp::test
{

/// The Kirchhoff stress dW/dF F^T of a solid with the energy W(F), by central differences.
template <class Energy>
Matrix<3> stress_of_energy(const Energy& energy, const Matrix<3>& f)
{
  const double step = 1e-6;
  Matrix<3> first_piola;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Matrix<3> more = f, less = f;
      more(i, j) += step;
      less(i, j) -= step;
      first_piola(i, j) = (energy(more) - energy(less)) / (2 * step);
    }
  }
  return first_piola * f.transpose();
}

}  // namespace tamp::test
