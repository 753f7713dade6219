#pragma once

#include <cmath>

#include "components/geometry/solid.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/tensors.hpp"

/// Contact of matter with a rigid body whose surface is that of its solid, not of its particles.
namespace tamp::components
{

/// A rigid body's solid where the body is now: it has turned about `start`, which has come to `centre`.
template <int D>
struct PlacedSolid {
  /// Tells rigid bodies apart.
  std::size_t number;
  const Solid<D>& solid;
  /// Around the solid at its start.
  Box<D> box;
  Matrix<D> turn;
  Vector<D> start, centre;

  /// Whether `x` is further than `distance` from the box around the solid.
  bool is_far(const Vector<D>& x, double distance) const;
  SignedDistance<D> distance(const Vector<D>& x) const;

 private:
  Vector<D> at_start(const Vector<D>& x) const { return start + turn.transpose() * (x - centre); }
};

/// Sums over the particles of a material near a rigid body, at the nodes that they reach. The nearest particles count
/// most: each with S_ip exp(-3 d / l), d being its distance from the solid and l its size.
template <int D>
struct GapSums : NodeValues<D, 8, 2> {
  double weight() const { return this->values[0]; }
  /// The soft minimum of the gaps between particles and solid [m]; below 0 where they overlap.
  double gap() const { return this->values[1] / weight(); }
  /// Out of the solid: of length 1, or 0 where that of its sides cancels.
  Vector<D> normal() const { return this->vector(2).stableNormalized(); }
  /// The number of the body. Not a whole one where two are near.
  double body() const { return this->values[at_body] / weight(); }

  GapSums& operator+=(const GapSums& other)
  {
    this->values += other.values;
    return *this;
  }
  GapSums mirrored(int axis) const
  {
    GapSums image = *this;
    image.mirror(axis);
    return image;
  }

  static constexpr int at_body = 2 + D;
};

/// Adds the particles within two cells of a surface, on either side, to the sums of their nodes; each counts for the
/// body that is nearest. Particles are `size` [m] long along each axis at first.
template <int D>
void add_gaps(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
              double size, std::span<const PlacedSolid<D>> bodies, GapSums<D>* sums);

}  // namespace tamp::components
