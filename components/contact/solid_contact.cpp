#include "components/contact/solid_contact.hpp"

#include <limits>
#include <optional>

#include "components/contact/soft_gap.hpp"
#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/stencil.hpp"

namespace tamp::components
{

template <int D>
bool PlacedSolid<D>::is_far(const Vector<D>& x, double distance) const
{
  const Vector<D> place = at_start(x);
  return ((place - box.upper).array() > distance).any() || ((box.lower - place).array() > distance).any();
}

template <int D>
SignedDistance<D> PlacedSolid<D>::distance(const Vector<D>& x) const
{
  const auto [value, normal] = solid.distance(at_start(x));
  return {value, turn * normal};
}

namespace
{

/// The body nearest to a particle, by its number.
template <int D>
struct NearBody {
  std::size_t body;
  SignedDistance<D> distance;
};

template <int D>
std::optional<NearBody<D>> nearest_to(const Vector<D>& x, std::span<const PlacedSolid<D>> bodies, double range)
{
  std::optional<NearBody<D>> nearest;
  for (const PlacedSolid<D>& body : bodies) {
    if (body.is_far(x, range)) continue;
    const SignedDistance<D> distance = body.distance(x);
    // Deep in a solid made of others none of their faces may be its own: that is no place to be pushed from.
    if (!(std::abs(distance.value) <= range) || (nearest && nearest->distance.value <= distance.value)) continue;
    nearest = {body.number, distance};
  }
  return nearest;
}

/// The share that a particle adds to its nodes, for S = 1.
template <int D>
GapSums<D> share_of(const NearBody<D>& near, const Matrix<D>* deformation, double size)
{
  const auto& [distance, normal] = near.distance;
  const double width = size * (deformation == nullptr ? 1.0 : (deformation->transpose() * normal).norm());
  const auto [weight, gap] = soft_gap(distance, width, size);
  GapSums<D> share;
  share.values[0] = weight;
  share.values[1] = weight * gap;
  share.set_vector(2, weight * normal);
  share.values[GapSums<D>::at_body] = weight * static_cast<double>(near.body);
  return share;
}

}  // namespace

template <int D>
void add_gaps(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
              double size, std::span<const PlacedSolid<D>> bodies, GapSums<D>* sums)
{
  const double range = 2 * block.cell_size;
  interpolation.with_shape([&](const auto& shape) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      const auto near = nearest_to<D>(places.position[p], bodies, range);
      if (!near) continue;
      const Matrix<D>* deformation = places.deformation_gradient.empty() ? nullptr : &places.deformation_gradient[p];
      const GapSums<D> share = share_of<D>(*near, deformation, size);
      for_each_stencil(shape, block, places.subspan(p, 1), [&](std::size_t, const auto& stencil) {
        for_each_weight(block, stencil,
                        [&](std::ptrdiff_t node, double weight) { sums[node].values += weight * share.values; });
      });
    }
  });
}

template struct PlacedSolid<2>;
template struct PlacedSolid<3>;
template void add_gaps(const Interpolation<2>&, const GridBlock<2>&, const ParticlePlaces<2>&, double,
                       std::span<const PlacedSolid<2>>, GapSums<2>*);
template void add_gaps(const Interpolation<3>&, const GridBlock<3>&, const ParticlePlaces<3>&, double,
                       std::span<const PlacedSolid<3>>, GapSums<3>*);

}  // namespace tamp::components
