#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace tamp::components
{

/// Coefficients of friction between any two of `n_groups` contact groups; symmetric. Every pair starts at one value.
class FrictionTable
{
 public:
  /// Touching bodies never slide on each other; they may still part.
  static constexpr double no_slip = std::numeric_limits<double>::infinity();

  /// Throws BadValue for a coefficient below 0 or not a number, or fewer than one group.
  explicit FrictionTable(int n_groups, double friction = 0);

  int n_groups() const { return n_groups_; }

  double operator()(int a, int b) const { return friction_[place(a, b)]; }

  /// Sets the coefficient of a with b and of b with a. Throws BadValue for one below 0 or not a number, and for groups
  /// that are not two different ones of the table.
  void set(int a, int b, double friction);

 private:
  std::size_t place(int a, int b) const { return static_cast<std::size_t>(a * n_groups_ + b); }

  int n_groups_;
  std::vector<double> friction_;
};

}  // namespace tamp::components
