#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "components/contact/normals.hpp"

namespace tamp::components
{

/// How any two of `n_groups` contact groups meet: their coefficient of friction, and where their normal comes from.
/// Every pair starts with one coefficient and the normal of the flatter surface.
class ContactTable
{
 public:
  /// Touching bodies never slide on each other; they may still part.
  static constexpr double no_slip = std::numeric_limits<double>::infinity();

  /// Throws BadValue for a coefficient below 0 or not a number, or fewer than one group.
  explicit ContactTable(int n_groups, double friction = 0);

  int n_groups() const { return n_groups_; }

  double friction(int a, int b) const { return pairs_[place(a, b)].friction; }
  const ContactNormal& normal(int a, int b) const { return pairs_[place(a, b)].normal; }
  /// Whether any pair does.
  bool finds_faces() const;
  /// Whether the surface of this group takes part in the normal of any pair.
  bool needs_surface_of(int group) const;

  /// Sets the contact of a with b, which is that of b with a. Throws BadValue for a coefficient below 0 or not a
  /// number, for groups that are not two different ones of the table, and for the normal of a third.
  void set(int a, int b, double friction, const ContactNormal& normal = FlatterNormal());

 private:
  struct Pair {
    double friction;
    ContactNormal normal;
  };

  std::size_t place(int a, int b) const { return static_cast<std::size_t>(a * n_groups_ + b); }

  int n_groups_;
  std::vector<Pair> pairs_;
};

}  // namespace tamp::components
