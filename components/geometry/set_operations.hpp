#pragma once

#include <vector>

#include "components/geometry/solid.hpp"

/// Solids made of others. Their faces are those of their parts, some of which may lie within others. The volume of
/// parts whose bounding boxes are apart is exact; where they meet, what they share is counted at the points of a fixed
/// sequence, and the error is twice the standard error between parts of it.
namespace tamp::components
{

template <int D>
std::size_t n_shapes(const std::vector<Solid<D>>& parts)
{
  std::size_t n = 0;
  for (const Solid<D>& part : parts) n += part.n_shapes();
  return n;
}

/// Union: the points in at least one of the parts.
template <int D>
struct Union {
  std::vector<Solid<D>> parts;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  std::size_t n_shapes() const { return components::n_shapes(parts); }
  void check() const;
};

/// Intersection: the points in every part.
template <int D>
struct Intersection {
  std::vector<Solid<D>> parts;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  std::size_t n_shapes() const { return components::n_shapes(parts); }
  void check() const;
};

/// Difference: the points in the first part and in none of the others.
template <int D>
struct Difference {
  Solid<D> whole;
  std::vector<Solid<D>> without;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  std::size_t n_shapes() const { return whole.n_shapes() + components::n_shapes(without); }
};

}  // namespace tamp::components
