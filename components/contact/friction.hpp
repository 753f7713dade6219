#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>

#include "components/contact/contact_table.hpp"
#include "components/tensors.hpp"

/// Frictional contact at one grid node between materials that each carry their own velocity there. In the plane,
/// masses, impulses and energies are of one metre of thickness.
namespace tamp::components
{

/// Below which a material is not taken to be at the node, and a normal not to exist.
struct ContactThresholds {
  /// kg
  double mass = 0;
  /// Length of the vector that the normal comes from [m^(D-1)]; a small part, such as 1e-9, of (cell size)^(D-1)
  /// distinguishes it from round-off.
  double surface_gradient = 0;
};

/// The impulse on b, and so minus the impulse on a, with which two materials meet.
template <int D>
struct ContactImpulse {
  Vector<D> on_second = Vector<D>::Zero();
  /// Along the normal, before the impulse [m/s]; 0 where they do not approach.
  double approach_speed = 0;
};

/// Contact of two materials through a unit normal from a to b. If they approach, a normal impulse ends the approach and
/// a tangential one, at most `friction` times the normal, reduces their sliding but never turns it round. If they rest
/// or part, nothing: contact never holds bodies together. A mass may be infinite, for a body that the impulse does not
/// stop, but not both; the velocities are changed by impulse over mass, so finite masses keep their momentum.
template <int D>
ContactImpulse<D> collide(double mass_a, double mass_b, const Vector<D>& normal, double friction, Vector<D>& velocity_a,
                          Vector<D>& velocity_b)
{
  const Vector<D> relative = velocity_a - velocity_b;
  const double approach = relative.dot(normal);
  if (!(approach > 0)) return {};

  const Vector<D> sliding = relative - approach * normal;
  const double sliding_speed = sliding.norm();
  const double held = sliding_speed <= friction * approach ? 1.0 : friction * approach / sliding_speed;
  const double reduced_mass = 1 / (1 / mass_a + 1 / mass_b);

  ContactImpulse<D> impulse;
  impulse.on_second = reduced_mass * (approach * normal + held * sliding);
  impulse.approach_speed = approach;
  velocity_a -= impulse.on_second / mass_a;
  velocity_b += impulse.on_second / mass_b;
  return impulse;
}

/// The surfaces of all materials at one node; one entry of each span a material, in the order of the table.
template <int D>
struct NodeSurfaces {
  std::span<const Vector<D>> gradient;
  /// Contact faces; empty where no contact finds any.
  std::span<const ContactFace<D>> face{};
};

/// The unit normal from a to b along which the two meet at a node. None where they do not touch, or where it comes from
/// a vector no longer than `least_length`.
template <int D>
std::optional<Vector<D>> normal_at(const ContactTable& table, int a, int b, const NodeSurfaces<D>& at,
                                   double least_length)
{
  const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
  Vector<D> outward;
  if (!at.face.empty() && at.face[first].is_there()) {
    if (at.face[first].gap > 0) return std::nullopt;
    outward = at.face[first].outward;
  } else {
    outward = std::visit(
        [&](const auto& kind) {
          return kind.template outward<D>({a, at.gradient[first]}, {b, at.gradient[second]});
        },
        table.normal(a, b));
  }
  const double length = outward.norm();
  if (!(length > least_length)) return std::nullopt;
  return Vector<D>(outward / length);
}

/// Contact between all materials at one node; one entry of each span a material (contact group), in the order of the
/// table.
/// Two materials share one normal, so that the impulse on one is exactly minus that on the other.
/// Pairs a < b are resolved one after another, in that order, each with the velocities that the pairs before it left:
/// with three or more materials a later pair may leave an earlier one with some approach, which the next step ends. A
/// pair is left alone, sliding and all, where one of its masses is not above the threshold, or without a normal.
/// Returns the fastest approach of a pair [m/s]; 0 if none approach.
template <int D>
double resolve_contact(std::span<const double> mass, const NodeSurfaces<D>& surfaces, const ContactTable& table,
                       const ContactThresholds& thresholds, std::span<Vector<D>> velocity)
{
  double approach_speed = 0;
  for (std::size_t a = 0; a < mass.size(); ++a) {
    if (!(mass[a] > thresholds.mass)) continue;
    for (std::size_t b = a + 1; b < mass.size(); ++b) {
      if (!(mass[b] > thresholds.mass)) continue;
      const int first = static_cast<int>(a), second = static_cast<int>(b);
      const auto normal = normal_at<D>(table, first, second, surfaces, thresholds.surface_gradient);
      if (!normal) continue;
      const ContactImpulse<D> impulse =
          collide<D>(mass[a], mass[b], *normal, table.friction(first, second), velocity[a], velocity[b]);
      approach_speed = std::max(approach_speed, impulse.approach_speed);
    }
  }
  return approach_speed;
}

}  // namespace tamp::components
