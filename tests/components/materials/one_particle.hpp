#pragma once

#include <stdexcept>

#include "components/materials/invariants.hpp"
#include "components/materials/material_model.hpp"

namespace tamp::test
{

/// A particle of a model, and its update.
template <int D, class Model>
struct OneParticle {
  Matrix<D> deformation_gradient = Matrix<D>::Identity();
  SymmetricTensor<D> stress = SymmetricTensor<D>::Zero();
  typename Model::State state{};
  double bulk_modulus = 0, shear_modulus = 0, plastic_work = 0, opening = 0;
  components::UpdateCounts counts{};

  components::BatchFailure update(const Model& model, const SymmetricTensor<D>& increment)
  {
    components::MaterialBatch<D, typename Model::State> batch{.strain_increment = {&increment, 1},
                                                              .deformation_gradient = {&deformation_gradient, 1},
                                                              .old_state = {&state, 1},
                                                              .stress = {&stress, 1},
                                                              .state = {&state, 1},
                                                              .bulk_modulus = {&bulk_modulus, 1},
                                                              .shear_modulus = {&shear_modulus, 1},
                                                              .plastic_work = {&plastic_work, 1}};
    if (components::keeps_gaps(model)) batch.old_opening = batch.opening = {&opening, 1};
    return components::update(model, batch, counts);
  }

  /// Throws std::runtime_error where the update fails.
  void strain(const Model& model, const SymmetricTensor<D>& increment)
  {
    if (const auto failure = update(model, increment)) throw std::runtime_error(to_string(failure->fault));
  }
  void strain(const Model& model, const SymmetricTensor<D>& total, int n_steps)
  {
    for (int i = 0; i < n_steps; ++i) strain(model, total / n_steps);
  }

  double pressure() const { return components::invariants(stress).pressure; }
  double sqrt_j2() const { return components::invariants(stress).sqrt_j2(); }
};

}  // namespace tamp::test
