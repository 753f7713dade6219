#pragma once

#include <fmt/core.h>

#include <cmath>

#include "components/errors.hpp"
#include "components/problems/body_functions.hpp"

/// Functions that problems of a ring share, whose members are `centre`, `inner_radius`, `outer_radius` and `on_rings`.
namespace tamp::components
{

/// Whether a body may have a problem of a ring. Throws BadValue or BadParameter where not.
template <class P>
void check_annulus(const P& problem, const ProblemBody& body)
{
  if (body.dimension != 2) throw BadValue("a scene of dimension 3", "one of dimension 2, in which it is a ring");
  if (!(problem.inner_radius < problem.outer_radius)) {
    throw BadParameter("inner_radius", fmt::format("{}", problem.inner_radius), "less than the outer radius");
  }
}

/// Where a point of the plane is, seen from a centre.
struct PolarPlace {
  double radius;  ///< m, above 0
  Vector<3> outwards;
  /// Anticlockwise.
  Vector<3> around;
};

inline PolarPlace polar_place(const Vector<3>& X, const Vector<3>& centre)
{
  const Vector<3> arm(X[0] - centre[0], X[1] - centre[1], 0);
  const double radius = std::sqrt(arm.squaredNorm());
  const Vector<3> outwards = arm / radius;
  return {radius, outwards, {-outwards[1], outwards[0], 0}};
}

/// The region that the problem is set for, and the particles' places where they lie on rings.
template <class P>
void set_region(const P& problem, BodyFunctions& functions)
{
  functions.holds = [inner = problem.inner_radius, outer = problem.outer_radius,
                     centre = problem.centre](const Vector<3>& X) {
    const double radius = polar_place(X, centre).radius;
    return radius >= inner && radius <= outer;
  };
  if (!problem.on_rings) return;
  functions.layout = PolarLayout{problem.centre.template head<2>(), problem.inner_radius, problem.outer_radius};
}

/// A ring that starts undeformed and goes as `motion` has it, by the body force that this needs.
template <class P, class Motion>
BodyFunctions functions_of(const P& problem, const Motion& motion)
{
  BodyFunctions functions;
  functions.velocity = [motion](const Vector<3>& X) { return motion.initial_velocity(X); };
  functions.body_force = [motion](const Vector<3>& X, double t) { return motion.body_force(X, t); };
  functions.exact_displacement = [motion](const Vector<3>& X, double t) { return motion.displacement(X, t); };
  set_region(problem, functions);
  return functions;
}

}  // namespace tamp::components
