#pragma once

#include <fmt/core.h>

#include <cmath>

#include "components/errors.hpp"
#include "components/problems/body_functions.hpp"

/// Functions that problems of a ring share, whose members are `centre`, `inner_radius`, `outer_radius` and `on_rings`.
namespace tamp::components
{

/// The shells at equal distance from the centre of a problem: circles in the plane, cylinders about the axis of an
/// axisymmetric scene, or spheres.
enum class Shells { circles, cylinders, spheres };

/// How many principal stretches are those of hoops.
constexpr int n_hoops(Shells shells)
{
  return shells == Shells::spheres ? 2 : 1;
}

template <class P>
void check_radii(const P& problem)
{
  if (!(problem.inner_radius < problem.outer_radius)) {
    throw BadParameter("inner_radius", fmt::format("{}", problem.inner_radius), "less than the outer radius");
  }
}

/// Whether a body may have a problem of circles. Throws BadValue or BadParameter where not.
template <class P>
void check_annulus(const P& problem, const ProblemBody& body)
{
  if (body.dimension != 2) throw BadValue("a scene of dimension 3", "one of dimension 2, in which it is a ring");
  if (body.axisymmetric) throw BadValue("an axisymmetric scene", "one of plane strain, in which it is a ring");
  check_radii(problem);
}

/// The shells of a problem that may be `spherical`. Throws BadValue or BadParameter where the scene cannot have them.
template <class P>
Shells shells_of(const P& problem, const ProblemBody& body)
{
  const bool in_space = body.dimension == 3 || body.axisymmetric;
  if (problem.spherical && !in_space) {
    throw BadParameter("spherical", "true, in a scene of plane strain", "an axisymmetric scene, or one of dimension 3");
  }
  if (body.dimension == 3 && !problem.spherical) {
    throw BadValue("a scene of dimension 3", "one of dimension 2, or spherical shells");
  }
  if (body.axisymmetric && problem.centre[0] != 0) {
    throw BadParameter("centre", fmt::format("a place at r = {} m", problem.centre[0]), "one on the axis, x = 0");
  }
  if (in_space && problem.on_rings) {
    throw BadParameter("on_rings", "true, in a scene that is no plane", "false, so that particles lie in the lattice");
  }
  check_radii(problem);
  if (problem.spherical) return Shells::spheres;
  return body.axisymmetric ? Shells::cylinders : Shells::circles;
}

/// A point in polar coordinates about a centre.
struct PolarPlace {
  double radius;  ///< m, above 0
  Vector<3> outwards;
  /// Anticlockwise in the plane of x and y.
  Vector<3> around;
};

inline PolarPlace polar_place(const Vector<3>& X, const Vector<3>& centre, Shells shells = Shells::circles)
{
  Vector<3> arm = X - centre;
  if (shells != Shells::spheres) arm[2] = 0;
  if (shells == Shells::cylinders) arm[1] = 0;
  const double radius = std::sqrt(arm.squaredNorm());
  const Vector<3> outwards = arm / radius;
  return {radius, outwards, {-outwards[1], outwards[0], 0}};
}

/// The region that the problem is set for, and the particles' places where they lie on rings.
template <class P>
void set_region(const P& problem, BodyFunctions& functions, Shells shells = Shells::circles)
{
  functions.holds = [inner = problem.inner_radius, outer = problem.outer_radius, centre = problem.centre,
                     shells](const Vector<3>& X) {
    const double radius = polar_place(X, centre, shells).radius;
    return radius >= inner && radius <= outer;
  };
  if (!problem.on_rings) return;
  functions.layout = PolarLayout{problem.centre.template head<2>(), problem.inner_radius, problem.outer_radius};
}

/// A ring that starts undeformed and goes as `motion` has it, by the body force that this needs.
template <class P, class Motion>
BodyFunctions functions_of(const P& problem, const Motion& motion, Shells shells = Shells::circles)
{
  BodyFunctions functions;
  functions.velocity = [motion](const Vector<3>& X) { return motion.initial_velocity(X); };
  functions.body_force = [motion](const Vector<3>& X, double t) { return motion.body_force(X, t); };
  functions.exact_displacement = [motion](const Vector<3>& X, double t) { return motion.displacement(X, t); };
  set_region(problem, functions, shells);
  return functions;
}

}  // namespace tamp::components
