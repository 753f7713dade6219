#include "components/problems/compacted_column.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "components/curves/monotone_cubic.hpp"
#include "components/portable_math.hpp"
#include "components/problems/stress_path.hpp"

namespace tamp::components
{

namespace
{

/// sigma_xx [Pa] against ln F_xx from 0 to `last`, which is below 0, in uniaxial strain.
MonotoneCubic uniaxial_stress(const MaterialModel& material, double last)
{
  StressPath path = straight_stress_path(material, {1, 0, 0}, last);
  std::ranges::reverse(path.length);
  std::ranges::reverse(path.along_x);
  return {path.length, path.along_x};
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
  const double last = portable::log(1 - compaction);
  const ColumnMotion motion{*this, body.density,
                            std::make_shared<const MonotoneCubic>(uniaxial_stress(body.material, last))};
  BodyFunctions functions;
  functions.velocity = [](const Vector<3>&) -> Vector<3> { return Vector<3>::Zero(); };
  functions.body_force = [motion](const Vector<3>& X, double t) { return motion.body_force(X, t); };
  functions.exact_displacement = [motion](const Vector<3>& X, double t) { return motion.displacement(X, t); };
  return functions;
}

}  // namespace tamp::components
