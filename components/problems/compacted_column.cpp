#include "components/problems/compacted_column.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "components/curves/monotone_cubic.hpp"
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

/// sigma_xx [Pa] against ln F_xx from 0 to `last`, in uniaxial strain.
template <class Model>
MonotoneCubic stress_path(const Model& of_scene, double last)
{
  const Model model = accurate(of_scene);
  const double step = last / n_increments;
  const SymmetricTensor<2> increment(step, 0, 0, 0);
  SymmetricTensor<2> stress = SymmetricTensor<2>::Zero();
  Matrix<2> f = Matrix<2>::Identity();
  typename Model::State state{};
  double bulk_modulus = 0, shear_modulus = 0, plastic_work = 0;
  UpdateCounts counts;
  std::vector<double> strains{0}, stresses{0};
  for (int i = 1; i <= n_increments; ++i) {
    f(0, 0) = portable::exp(i * step);
    const auto failure = update(model,
                                MaterialBatch<2, typename Model::State>{.strain_increment = {&increment, 1},
                                                                        .deformation_gradient = {&f, 1},
                                                                        .old_state = {&state, 1},
                                                                        .stress = {&stress, 1},
                                                                        .state = {&state, 1},
                                                                        .bulk_modulus = {&bulk_modulus, 1},
                                                                        .shear_modulus = {&shear_modulus, 1},
                                                                        .plastic_work = {&plastic_work, 1}},
                                counts);
    if (failure) {
      throw BadValue(fmt::format("a material that finds no stress at a compaction of {:.3g}", 1 - f(0, 0)),
                     "one that can be compacted as far as is asked for");
    }
    strains.push_back(i * step);
    stresses.push_back(stress[0]);
  }
  std::ranges::reverse(strains);
  std::ranges::reverse(stresses);
  return {strains, stresses};
}

/// The solution and its derivatives.
struct ColumnMotion {
  CompactedColumn column;
  double density;
  std::shared_ptr<const MonotoneCubic> stress;

  static constexpr double pi = std::numbers::pi;

  double tau(double t) const { return std::min(t / column.duration, 1.0); }
  /// S s and its second derivative by time.
  double compaction(double t) const { return column.compaction * (tau(t) - portable::sin(2 * pi * tau(t)) / (2 * pi)); }
  double compaction_acceleration(double t) const
  {
    return column.compaction * 2 * pi * portable::sin(2 * pi * tau(t)) / (column.duration * column.duration);
  }
  /// -u over S s [m].
  double shape(double x) const { return 0.5 * (x + column.length / pi * portable::sin(pi * x / column.length)); }
  Vector<3> displacement(const Vector<3>& X, double t) const { return {-compaction(t) * shape(X[0]), 0, 0}; }
  Vector<3> body_force(const Vector<3>& X, double t) const
  {
    const double k = pi / column.length, S = compaction(t);
    const double stretch = 1 - 0.5 * S * (1 + portable::cos(k * X[0]));
    const double curvature = 0.5 * S * k * portable::sin(k * X[0]);
    const double tangent = stress->at(portable::log(stretch)).slope;
    return {-compaction_acceleration(t) * shape(X[0]) - tangent * curvature / stretch / density, 0, 0};
  }
};

}  // namespace

BodyFunctions CompactedColumn::functions(const ProblemBody& body) const
{
  const auto path_of = [&](const auto& model) { return stress_path(model, portable::log(1 - compaction)); };
  const ColumnMotion motion{*this, body.density,
                            std::make_shared<const MonotoneCubic>(std::visit(path_of, body.material))};
  BodyFunctions functions;
  functions.velocity = [](const Vector<3>&) -> Vector<3> { return Vector<3>::Zero(); };
  functions.body_force = [motion](const Vector<3>& X, double t) { return motion.body_force(X, t); };
  functions.exact_displacement = [motion](const Vector<3>& X, double t) { return motion.displacement(X, t); };
  return functions;
}

}  // namespace tamp::components
