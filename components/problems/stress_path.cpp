#include "components/problems/stress_path.hpp"

#include <fmt/core.h>

#include "components/errors.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// Increments of the path of stress.
constexpr int n_increments = 4000;

/// The material with its stress found as well as it can be.
template <class Model>
Model accurate(const Model& model)
{
  return model;
}
TabularCap accurate(const TabularCap& sand)
{
  TabularCapParameters parameters = sand.parameters();
  parameters.tolerance = 1e-8;
  parameters.max_substeps = 100'000;
  return TabularCap(parameters);
}

template <int D, class Model>
StressPath straight_path(const Model& of_scene, const Vector<3>& direction, double last)
{
  const Model model = accurate(of_scene);
  const double step = last / n_increments;
  SymmetricTensor<D> increment = SymmetricTensor<D>::Zero(), stress = SymmetricTensor<D>::Zero();
  increment.template head<3>() = step * direction;
  Matrix<D> f = Matrix<D>::Identity();
  typename Model::State state{};
  double bulk_modulus = 0, shear_modulus = 0, plastic_work = 0;
  UpdateCounts counts;
  StressPath path{{0}, {0}, {0}};
  for (int i = 1; i <= n_increments; ++i) {
    for (int k = 0; k < D; ++k) f(k, k) = portable::exp(i * step * direction[k]);
    const auto failure = update(model,
                                MaterialBatch<D, typename Model::State>{.strain_increment = {&increment, 1},
                                                                        .deformation_gradient = {&f, 1},
                                                                        .old_state = {&state, 1},
                                                                        .stress = {&stress, 1},
                                                                        .state = {&state, 1},
                                                                        .bulk_modulus = {&bulk_modulus, 1},
                                                                        .shear_modulus = {&shear_modulus, 1},
                                                                        .plastic_work = {&plastic_work, 1}},
                                counts);
    if (failure) {
      throw BadValue(fmt::format("a material that finds no stress at stretches of {:.3g} and {:.3g}", f(0, 0), f(1, 1)),
                     "one that can be strained as far as is asked for");
    }
    path.length.push_back(i * step);
    path.along_x.push_back(stress[0]);
    path.along_y.push_back(stress[1]);
  }
  return path;
}

}  // namespace

StressPath straight_stress_path(const MaterialModel& material, const Vector<3>& direction, double last)
{
  const bool in_plane = direction[2] == 0;
  return std::visit(
      [&](const auto& model) {
        return in_plane ? straight_path<2>(model, direction, last) : straight_path<3>(model, direction, last);
      },
      material);
}

}  // namespace tamp::components
