#pragma once

#include <vector>

#include "components/tensors.hpp"

namespace tamp::components
{

/// How a body is driven: the velocity of its centre against time, whatever resists. Made from a few points of it or of
/// the displacement, with straight lines between them.
class PrescribedMotion
{
 public:
  /// The vector at a time [s].
  struct Point {
    double time;
    Vector<3> value;
  };

  /// Velocities [m/s]; before the first and after the last they are constant. Throws BadValue unless there is one, and
  /// the times ascend.
  static PrescribedMotion of_velocities(const std::vector<Point>& points);
  /// Displacements from the start [m], the first of them zero; before the first and after the last the body rests.
  /// Throws BadValue unless there are two, and the times ascend.
  static PrescribedMotion of_displacements(const std::vector<Point>& points);

  /// The way from one time to a later one [m].
  Vector<3> way(double from, double to) const;
  /// Velocity just after a time [m/s].
  Vector<3> velocity(double time) const;
  /// Whether it ever moves along an axis.
  bool has_part_along(int axis) const;

 private:
  /// A piece of the motion, in which the velocity changes linearly between two times.
  struct Piece {
    double begin, end;
    Vector<3> first, last;

    Vector<3> velocity(double time) const;
  };

  explicit PrescribedMotion(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  /// Pieces that cover all times, each beginning where the one before ends.
  std::vector<Piece> pieces_;
};

}  // namespace tamp::components
