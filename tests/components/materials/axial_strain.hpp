#pragma once

#include <cmath>

#include "tests/components/materials/one_particle.hpp"

namespace tamp::test
{

/// At rest under the same pressure all around.
template <int D, class Model>
OneParticle<D, Model> confined_particle(double pressure)
{
  OneParticle<D, Model> sample;
  sample.stress = -isotropic<n_symmetric<D>>(pressure);
  return sample;
}

/// Strains by `axial` along x, with the lateral strain that keeps the stress along y, found by bisection. `across`
/// makes a strain of the two.
template <int D, class Model, class Across>
void strain_axially(const Model& model, double axial, const Across& across, OneParticle<D, Model>& sample)
{
  const double held = sample.stress[1];
  const auto after = [&](double lateral) {
    OneParticle<D, Model> trial = sample;
    trial.strain(model, across(axial, lateral));
    return trial;
  };
  double low = -100 * std::abs(axial), high = 100 * std::abs(axial);
  for (int i = 0; i < 200 && high - low > 1e-16 * std::abs(axial); ++i) {
    const double middle = 0.5 * (low + high);
    (after(middle).stress[1] < held ? low : high) = middle;
  }
  sample = after(0.5 * (low + high));
}

inline SymmetricTensor<3> triaxial(double axial, double lateral)
{
  return (SymmetricTensor<3>() << axial, lateral, lateral, 0, 0, 0).finished();
}

inline SymmetricTensor<2> plane(double axial, double lateral)
{
  return (SymmetricTensor<2>() << axial, lateral, 0, 0).finished();
}

}  // namespace tamp::test
