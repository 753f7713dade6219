#pragma once

#include <algorithm>
#include <string_view>
#include <variant>

#include "components/tensors.hpp"

/// Where the normal that two contact groups share comes from. Each kind has
///
///     word, or shown, and meaning        as scenes and their documentation have it
///     acts_apart                         whether bodies may push each other before they touch
///     finds_faces                        whether a pass of its own finds a ContactFace at nodes where the two are
///     alone needs_surface_of(group)            whether it asks for the surface of this one of the two outward(first,
///     second)             the direction from the first to the second, not of unit length, from their
///                                        surfaces at a node; where it finds faces, at nodes that have none
///
/// and is listed at the end.
namespace tamp::components
{

/// A contact group at a node: G = sum_p V_p grad S_ip, which points out of its material.
template <int D>
struct GroupSurface {
  int group;
  const Vector<D>& gradient;
};

/// The direction in which two materials face each other, from a to b; not of unit length, and zero where there is none.
///
/// At a flat surface G is as long as it gets; at an edge, part of the surroundings is missing and G is shorter and
/// leans. So the longer of the two speaks for both, and the shorter joins in only as it comes to the same length: a
/// block's lower edges then slide along the ground instead of ploughing into it.
template <int D>
Vector<D> facing(const Vector<D>& gradient_a, const Vector<D>& gradient_b)
{
  constexpr double joins_from = 0.9;
  const double length_a = gradient_a.norm(), length_b = gradient_b.norm();
  const double ratio = std::min(length_a, length_b) / std::max(length_a, length_b);
  const double share = std::max(0.0, (ratio - joins_from) / (1 - joins_from));
  return length_a > length_b ? Vector<D>(gradient_a - share * gradient_b) : Vector<D>(share * gradient_a - gradient_b);
}

struct FlatterNormal {
  static constexpr std::string_view word = "flatter",
                                    meaning =
                                        "that of the flatter surface at each node, where bodies may push before "
                                        "they touch";
  static constexpr bool finds_faces = false;
  static constexpr bool acts_apart = true;
  friend bool operator==(const FlatterNormal&, const FlatterNormal&) = default;

  bool needs_surface_of(int) const { return true; }
  template <int D>
  Vector<D> outward(const GroupSurface<D>& first, const GroupSurface<D>& second) const
  {
    return facing<D>(first.gradient, second.gradient);
  }
};

/// See logistic_plane.hpp.
struct RegressionNormal {
  static constexpr std::string_view
      word = "regression",
      meaning =
          "that of a plane between their particles at each node, which jitters less: they push each other only where "
          "they touch; where a third material is, that of the flatter surface";
  static constexpr bool finds_faces = true;
  static constexpr bool acts_apart = false;
  friend bool operator==(const RegressionNormal&, const RegressionNormal&) = default;

  bool needs_surface_of(int) const { return true; }
  template <int D>
  Vector<D> outward(const GroupSurface<D>& first, const GroupSurface<D>& second) const
  {
    return facing<D>(first.gradient, second.gradient);
  }
};

struct OwnNormal {
  static constexpr std::string_view shown = "A or B",
                                    meaning =
                                        "that of this material's surface, as suits a stiff body that is driven "
                                        "into a soft one";
  static constexpr bool finds_faces = false;
  static constexpr bool acts_apart = true;
  friend bool operator==(const OwnNormal&, const OwnNormal&) = default;

  int owner;  ///< one of the two groups

  bool needs_surface_of(int group) const { return group == owner; }
  template <int D>
  Vector<D> outward(const GroupSurface<D>& first, const GroupSurface<D>& second) const
  {
    return owner == first.group ? first.gradient : Vector<D>(-second.gradient);
  }
};

/// The normal of a rigid body's solid, see solid_contact.hpp. It is not computed at the nodes from the sums of two
/// materials.
struct SolidNormal {
  static constexpr std::string_view
      word = "solid",
      meaning = "that of the solid of a rigid body, which others touch at its surface, whatever its particles";
  static constexpr bool finds_faces = false;
  static constexpr bool acts_apart = false;
  friend bool operator==(const SolidNormal&, const SolidNormal&) = default;

  bool needs_surface_of(int) const { return false; }
  template <int D>
  Vector<D> outward(const GroupSurface<D>&, const GroupSurface<D>&) const
  {
    return Vector<D>::Zero();
  }
};

/// All kinds of normals; a new kind is added here.
using ContactNormal = std::variant<FlatterNormal, RegressionNormal, OwnNormal, SolidNormal>;

/// Whether bodies may push each other before they touch.
inline bool acts_apart(const ContactNormal& normal)
{
  return std::visit([](const auto& kind) { return kind.acts_apart; }, normal);
}

inline bool finds_faces(const ContactNormal& normal)
{
  return std::visit([](const auto& kind) { return kind.finds_faces; }, normal);
}

/// Where and how two materials meet at a node, found by a pass of their contact's own.
template <int D>
struct ContactFace {
  /// Out of this material and into the other; not of unit length, and zero at nodes without a face.
  Vector<D> outward = Vector<D>::Zero();
  /// Gap that would be left at the end of the step without contact [m]: the materials touch if it is 0 or below.
  double gap = 0;

  bool is_there() const { return !outward.isZero(0); }
};

}  // namespace tamp::components
