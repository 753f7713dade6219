#include "components/shapes/interpolation.hpp"

#include "components/shapes/dense_transfer.hpp"
#include "components/shapes/own_stiffness.hpp"

namespace tamp::components
{

namespace
{

/// The kernels with the weights of one interpolator, for particles of one size.
template <class Shape, int D = Shape::dimension>
class InterpolationBy final : public Interpolation<D>
{
 public:
  InterpolationBy(const Shape& shape, Interpolator interpolator, int n_per_axis, Plane plane)
      : Interpolation<D>(interpolator, n_per_axis), shape_(shape), plane_(plane)
  {
  }

  double greatest_own_stiffness() const override
  {
    const double of_gradients =
        components::greatest_own_stiffness(D, this->n_per_axis(), shape_.greatest_stiffness_along_axis());
    return plane_ == Plane::slab ? of_gradients
                                 : of_gradients + components::greatest_hoop_stiffness(this->n_per_axis());
  }

  void particles_to_grid(const GridBlock<D>& block, const ParticleSources<D>& from, bool with_surface,
                         NodeSums<D>* sums) const override
  {
    with_plane([&]<Plane plane>() {
      if (from.carried_gradient == CarriedGradient::none) return bring<false, plane>(block, from, with_surface, sums);
      bring<true, plane>(block, from, with_surface, sums);
    });
  }

  void grid_to_particles(const GridBlock<D>& block, const ParticlePlaces<D>& places, const NodeMotion<D>* nodes,
                         const ParticleTargets<D>& to) const override
  {
    with_plane([&]<Plane plane>() {
      components::grid_to_particles<Shape, D, plane>(shape_, this->n_per_axis(), block, places, nodes, to);
    });
  }

  void interpolate(const GridBlock<D>& block, const ParticlePlaces<D>& places, const NodeVector<D>* nodes,
                   std::span<Vector<D>> values) const override
  {
    components::interpolate(shape_, block, places, nodes, values);
  }

  void add_vectors(const GridBlock<D>& block, const ParticlePlaces<D>& places, std::span<const Vector<D>> vectors,
                   NodeVector<D>* sums) const override
  {
    components::add_vectors(shape_, block, places, vectors, sums);
  }

  void second_moments(const GridBlock<D>& block, const ParticlePlaces<D>& places,
                      std::span<Matrix<D>> moments) const override
  {
    components::second_moments(shape_, block, places, moments);
  }

 private:
  /// Calls `run.operator()<plane>()`; space is no plane.
  template <class Run>
  void with_plane(const Run& run) const
  {
    if constexpr (D == 2) {
      if (plane_ == Plane::revolved) return run.template operator()<Plane::revolved>();
    }
    run.template operator()<Plane::slab>();
  }

  template <bool carries, Plane plane>
  void bring(const GridBlock<D>& block, const ParticleSources<D>& from, bool with_surface, NodeSums<D>* sums) const
  {
    if (with_surface) return components::particles_to_grid<true, carries, plane>(shape_, block, from, sums);
    components::particles_to_grid<false, carries, plane>(shape_, block, from, sums);
  }

  Shape shape_;
  Plane plane_;
};

}  // namespace

template <int D>
std::unique_ptr<const Interpolation<D>> Interpolation<D>::make(Interpolator interpolator, int n_per_axis, Plane plane)
{
  return components::with_shape<D>(
      interpolator, n_per_axis, [&]<class Shape>(const Shape& shape) -> std::unique_ptr<const Interpolation> {
        return std::make_unique<InterpolationBy<Shape>>(shape, interpolator, n_per_axis, plane);
      });
}

template class Interpolation<2>;
template class Interpolation<3>;

}  // namespace tamp::components
