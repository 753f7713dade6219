#pragma once

#include <memory>
#include <span>

#include "components/shapes/grid_block.hpp"
#include "components/shapes/interpolator.hpp"
#include "components/shapes/transfer.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Transfers between the particles of one material and the grid, by any interpolator: each call takes a batch of
/// particles, so that only its one definition knows how weights are made. In all of them `block` is where the nodes
/// stand, and pointers are to its first node.
template <int D>
class Interpolation
{
 public:
  /// For `n_per_axis` particles along each axis of a cell; in space `plane` says nothing.
  static std::unique_ptr<const Interpolation> make(Interpolator interpolator, int n_per_axis,
                                                   Plane plane = Plane::slab);
  virtual ~Interpolation() = default;

  /// The greatest own stiffness of a particle, one that has its nodes to itself.
  virtual double greatest_own_stiffness() const = 0;

  /// See components::particles_to_grid, and so on.
  virtual void particles_to_grid(const GridBlock<D>& block, const ParticleSources<D>& from, bool with_surface,
                                 NodeSums<D>* sums) const = 0;
  virtual void grid_to_particles(const GridBlock<D>& block, const ParticlePlaces<D>& places, const NodeMotion<D>* nodes,
                                 const ParticleTargets<D>& to) const = 0;
  virtual void interpolate(const GridBlock<D>& block, const ParticlePlaces<D>& places, const NodeVector<D>* nodes,
                           std::span<Vector<D>> values) const = 0;
  virtual void add_vectors(const GridBlock<D>& block, const ParticlePlaces<D>& places,
                           std::span<const Vector<D>> vectors, NodeVector<D>* sums) const = 0;
  virtual void second_moments(const GridBlock<D>& block, const ParticlePlaces<D>& places,
                              std::span<Matrix<D>> moments) const = 0;

  int n_per_axis() const { return n_per_axis_; }
  /// Calls `visit(shape)` with the weights, see interpolator.hpp: for sums that are not among the above.
  template <class Visit>
  void with_shape(const Visit& visit) const
  {
    components::with_shape<D>(interpolator_, n_per_axis_, visit);
  }

 protected:
  Interpolation(Interpolator interpolator, int n_per_axis) : interpolator_(interpolator), n_per_axis_(n_per_axis) {}

 private:
  Interpolator interpolator_;
  int n_per_axis_;
};

}  // namespace tamp::components
