#include "tools/run/drive/stress_control.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tamp::tools
{

namespace
{

constexpr int most_controls = 6;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_controls, 1>;
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_controls, most_controls>;

/// A point at the end of an increment that was tried.
struct Trial {
  Unknowns change;  ///< change of the entries of F that are not prescribed
  MaterialPoint point;
  Unknowns excess;  ///< controlled stresses less those wanted, Pa
};

/// The controlled stresses at the end of an increment, as functions of the entries of F that give way.
class StressEquations
{
 public:
  StressEquations(const tasks::MaterialModel& material, const MixedTarget& target, const MaterialPoint& start)
      : material_(material),
        target_(target),
        start_(start),
        unchanged_(completed(target.deformation_gradient, target.controls, start.deformation_gradient))
  {
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(target_.controls.size()); }

  /// The trial after a change; empty where the material refuses the deformation.
  std::optional<Trial> at(const Unknowns& change) const
  {
    Trial trial{change, start_, {}};
    if (deform(material_, deformation_gradient(change), trial.point)) return std::nullopt;
    trial.excess = excess_of(trial.point.stress);
    return trial;
  }

  bool is_solved_by(const Trial& trial) const
  {
    double level = trial.point.stress.lpNorm<Eigen::Infinity>();
    for (const double stress : target_.stress) level = std::max(level, std::abs(stress));
    const double modulus = trial.point.bulk_modulus + 4 * trial.point.shear_modulus / 3;
    return trial.excess.lpNorm<Eigen::Infinity>() <= 1e-10 * level + 1e-12 * modulus;
  }

  /// The solution if the increment were elastic. The iteration begins there: on the compressed side of a cone's apex,
  /// where there is stiffness.
  Unknowns elastic_change() const
  {
    Jacobian stiffness(size(), size());
    for (Eigen::Index k = 0; k < size(); ++k) stiffness.col(k) = picked(elastic_stress(control(k).direction));
    const Matrix<3> prescribed_change = unchanged_ - start_.deformation_gradient;
    const SymmetricTensor<3> stress = start_.stress + elastic_stress(prescribed_change);
    return solution(stiffness, excess_of(stress)).value_or(Unknowns::Zero(size()));
  }

  /// By differences. Normal components are varied towards compression, as soil in tension has no stiffness.
  std::optional<Jacobian> jacobian(const Trial& trial) const
  {
    constexpr double variation = -1e-6;
    Jacobian slopes(size(), size());
    for (Eigen::Index k = 0; k < size(); ++k) {
      const std::optional<Trial> varied = at(trial.change + variation * Unknowns::Unit(size(), k));
      if (!varied) return std::nullopt;
      slopes.col(k) = (varied->excess - trial.excess) / variation;
    }
    return slopes;
  }

  /// The change that takes the excess away; nothing where the slopes are singular.
  static std::optional<Unknowns> solution(const Jacobian& slopes, const Unknowns& excess)
  {
    const Eigen::FullPivLU<Jacobian> factors(slopes);
    if (!factors.isInvertible()) return std::nullopt;
    return -factors.solve(excess);
  }

 private:
  const StressControl& control(Eigen::Index k) const { return target_.controls[static_cast<std::size_t>(k)]; }

  Matrix<3> deformation_gradient(const Unknowns& change) const
  {
    Matrix<3> f = unchanged_;
    for (Eigen::Index k = 0; k < size(); ++k) f += change[k] * control(k).direction;
    return f;
  }

  Unknowns picked(const SymmetricTensor<3>& stress) const
  {
    Unknowns values(size());
    for (Eigen::Index k = 0; k < size(); ++k) values[k] = control(k).stress_of(stress);
    return values;
  }

  Unknowns excess_of(const SymmetricTensor<3>& stress) const
  {
    return picked(stress) - Unknowns::Map(target_.stress.data(), size());
  }

  SymmetricTensor<3> elastic_stress(const Matrix<3>& change) const
  {
    const auto strain = symmetric_part<3>(change * start_.deformation_gradient.inverse());
    return isotropic<6>(start_.bulk_modulus * trace(strain)) + 2 * start_.shear_modulus * deviator(strain);
  }

  const tasks::MaterialModel& material_;
  const MixedTarget& target_;
  const MaterialPoint& start_;
  /// F at the end if nothing gave way.
  Matrix<3> unchanged_;
};

Unknowns no_longer_than(double longest, const Unknowns& step)
{
  const double length = step.norm();
  return length > longest ? Unknowns(step * (longest / length)) : step;
}

/// Takes as much of the step as makes the excess less.
std::optional<Trial> damped_step(const StressEquations& equations, const Trial& from, const Unknowns& step)
{
  constexpr double shortest = 1.0 / 64;
  for (double part = 1; part >= shortest; part /= 2) {
    std::optional<Trial> trial = equations.at(from.change + part * step);
    if (trial && trial->excess.norm() < (1 - 1e-3 * part) * from.excess.norm()) return trial;
  }
  return std::nullopt;
}

}  // namespace

bool deform_to_stress(const tasks::MaterialModel& material, const MixedTarget& target, double largest_step,
                      MaterialPoint& point)
{
  constexpr int most_iterations = 30;
  const StressEquations equations(material, target, point);
  std::optional<Trial> trial = equations.at(no_longer_than(largest_step, equations.elastic_change()));
  for (int i = 0; trial && i < most_iterations; ++i) {
    if (equations.is_solved_by(*trial)) {
      point = std::move(trial->point);
      return true;
    }
    const std::optional<Jacobian> slopes = equations.jacobian(*trial);
    if (!slopes) return false;
    const std::optional<Unknowns> step = StressEquations::solution(*slopes, trial->excess);
    if (!step) return false;
    trial = damped_step(equations, *trial, no_longer_than(largest_step, *step));
  }
  return false;
}

}  // namespace tamp::tools
