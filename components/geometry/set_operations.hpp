#pragma once

#include <vector>

#include "components/geometry/solid.hpp"

/// Solids made of others. The volume of parts whose bounding boxes are apart is exact; where they meet, what they share
/// is counted at the points of a fixed sequence, and the error is twice the standard error between parts of it.
namespace tamp::components
{

/// What at least one of the parts holds.
template <int D>
struct Union {
  std::vector<Solid<D>> parts;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  Volume volume() const;
  void check() const;
};

/// What every one of the parts holds.
template <int D>
struct Intersection {
  std::vector<Solid<D>> parts;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  Volume volume() const;
  void check() const;
};

/// What the first holds and none of the others.
template <int D>
struct Difference {
  Solid<D> whole;
  std::vector<Solid<D>> without;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  Volume volume() const;
};

}  // namespace tamp::components
