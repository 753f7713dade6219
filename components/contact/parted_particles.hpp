#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "components/contact/logistic_plane.hpp"
#include "components/lanes.hpp"
#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/shapes/stencil.hpp"
#include "components/tensors.hpp"

/// The passes over the particles of one material that sum at the nodes with a plane. Few particles are near one: the
/// others cost a look at their cell. What the near ones add is worked out for as many pairs of particle and node at
/// once as the processor has lanes, and added pair by pair in their order.
namespace tamp::components
{

/// Particles in cells from which a node with a plane may be reached, collected from all of them.
template <int D, std::size_t capacity>
class NearParticles
{
 public:
  bool is_full() const { return n_ == capacity; }
  void clear() { n_ = 0; }
  void add(const ParticlePlaces<D>& places, std::size_t p)
  {
    position_[n_] = places.position[p];
    is_deformed_ = !places.deformation_gradient.empty();
    if (is_deformed_) deformation_gradient_[n_] = places.deformation_gradient[p];
    ++n_;
  }
  ParticlePlaces<D> places() const
  {
    const std::span position(position_.data(), n_);
    if (!is_deformed_) return {position};
    return {position, std::span(deformation_gradient_.data(), n_)};
  }

 private:
  std::array<Vector<D>, capacity> position_;
  std::array<Matrix<D>, capacity> deformation_gradient_;
  std::size_t n_ = 0;
  bool is_deformed_ = false;
};

/// Pairs of a particle and a node with a plane that it reaches.
template <int D, std::size_t capacity>
class PartedPairs
{
 public:
  bool has_room_for(std::size_t n) const { return n_ + n <= capacity; }
  /// Adds an entry if it `counts`, without a branch, which would be hard to predict.
  void add_if(bool counts, std::ptrdiff_t node, double shape, const Vector<D>& x)
  {
    node_[n_] = node;
    shape_[n_] = shape;
    for (std::size_t k = 0; k < D; ++k) x_[k][n_] = x[static_cast<int>(k)];
    n_ += std::size_t{counts};
  }

  /// Calls `visit(nodes, n, particles)` for n of them at once, and forgets them.
  template <class Visit>
  void take(const ContactPlane<D>* planes, const Visit& visit)
  {
    if (n_ > 0) repeat_last();
    for (std::size_t first = 0; first < n_; first += n_lanes) {
      const auto plane = [&](std::size_t l) -> const ContactPlane<D>& { return planes[node_[first + l]]; };
      const auto in_lanes = [&](const auto& numbers) {
        return Lanes(&numbers[first], std::experimental::element_aligned);
      };
      PartedParticle<D, Lanes> particles;
      particles.side = each_lane([&](std::size_t l) { return static_cast<double>(plane(l).side); });
      for (int k = 0; k <= D; ++k) {
        particles.coefficients[k] = each_lane([&](std::size_t l) { return plane(l).coefficients[k]; });
      }
      particles.shape = in_lanes(shape_);
      for (std::size_t k = 0; k < D; ++k) particles.x[static_cast<int>(k)] = in_lanes(x_[k]);
      visit(&node_[first], std::min(n_lanes, n_ - first), particles);
    }
    n_ = 0;
  }

 private:
  static constexpr std::size_t with_rest = capacity + n_lanes;

  /// Repeats the last entry in the lanes beyond it.
  void repeat_last()
  {
    std::fill_n(&node_[n_], n_lanes, node_[n_ - 1]);
    std::fill_n(&shape_[n_], n_lanes, shape_[n_ - 1]);
    for (auto& along : x_) std::fill_n(&along[n_], n_lanes, along[n_ - 1]);
  }

  std::array<std::ptrdiff_t, with_rest> node_;
  std::array<double, with_rest> shape_;
  std::array<std::array<double, with_rest>, D> x_;
  std::size_t n_ = 0;
};

/// Marks the cells from which nodes with a plane are reached, by any interpolator.
template <int D>
void mark_near_cells(const GridBlock<D>& block, ContactPlane<D>* planes);

/// Calls `act(p)` for the particles in marked cells.
template <int D, class Act>
void for_each_near(const GridBlock<D>& block, const ContactPlane<D>* planes, const ParticlePlaces<D>& places,
                   const Act& act)
{
  const double per_cell = 1 / block.cell_size;
  for (std::size_t first = 0; first < places.size(); first += n_lanes) {
    const std::size_t n = std::min(n_lanes, places.size() - first);
    Lanes cell = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      const auto axis = static_cast<int>(k);
      const Lanes x = each_lane([&](std::size_t l) { return places.position[first + std::min(l, n - 1)][axis]; });
      cell += owned_cell<Lanes>((x - block.origin[axis]) * per_cell, block.n_nodes[k]) *
              static_cast<double>(block.strides[k]);
    }
    for (std::size_t l = 0; l < n; ++l) {
      if (planes[static_cast<std::ptrdiff_t>(double{cell[l]})].is_near_cell) act(first + l);
    }
  }
}

/// Calls `visit(nodes, n, particles)` for all pairs of a particle and a node with a plane that it reaches, n of them at
/// once: particle after particle, and its nodes as they lie.
template <class Interpolator, int D = Interpolator::dimension, class Visit>
void for_each_parted(const Interpolator& interpolator, const GridBlock<D>& block, const ContactPlane<D>* planes,
                     const ParticlePlaces<D>& places, const Visit& visit)
{
  constexpr std::size_t n_nodes = DenseStencil<D, Interpolator::support>::n_nodes;
  NearParticles<D, 32> near;
  PartedPairs<D, 8 * n_nodes> pairs;
  const auto pair_up = [&] {
    const ParticlePlaces<D> near_places = near.places();
    for_each_stencil(interpolator, block, near_places, [&](std::size_t p, const auto& stencil) {
      if (!pairs.has_room_for(n_nodes)) pairs.take(planes, visit);
      const Vector<D> x = block.in_cells(near_places.position[p]) - block.cells_to(stencil.first);
      for_each_placed_weight(block, stencil, [&](std::ptrdiff_t node, double shape, const Vector<D>& cells) {
        pairs.add_if(planes[node].side != 0 && shape > 0, node, shape, x - cells);
      });
    });
    near.clear();
  };
  for_each_near(block, planes, places, [&](std::size_t p) {
    if (near.is_full()) pair_up();
    near.add(places, p);
  });
  pair_up();
  pairs.take(planes, visit);
}

/// Adds the particles' shares to the regression sums of nodes.
template <class Interpolator, int D = Interpolator::dimension>
void add_regression(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                    const ContactPlane<D>* planes, RegressionSums<D>* sums)
{
  constexpr std::size_t n_fours = sizeof(RegressionSums<D>) / sizeof(Quad);
  // As many as whole registers hold.
  constexpr std::size_t n_numbers = (4 * n_fours + n_lanes - 1) / n_lanes * n_lanes;
  for_each_parted(interpolator, block, planes, places,
                  [&](const std::ptrdiff_t* nodes, std::size_t n, const PartedParticle<D, Lanes>& particles) {
                    const auto shares = RegressionSums<D>::share(particles);
                    std::array<Lanes, n_numbers> numbers;
                    numbers.fill(0.0);
                    std::copy(shares.begin(), shares.end(), numbers.begin());
                    const auto share_of = by_lane(numbers);
                    for (std::size_t l = 0; l < n; ++l) {
                      for (std::size_t k = 0; k < n_fours; ++k) {
                        const Quad four(&share_of[l][4 * k], std::experimental::element_aligned);
                        sums[nodes[l]].add(static_cast<int>(4 * k), four);
                      }
                    }
                  });
}

/// Adds the shares of particles of edge `size` [cells] to the edge sums of nodes.
template <class Interpolator, int D = Interpolator::dimension>
void add_edges(const Interpolator& interpolator, double size, const GridBlock<D>& block,
               const ParticlePlaces<D>& places, const ContactPlane<D>* planes, EdgeSums<D>* sums)
{
  for_each_parted(interpolator, block, planes, places,
                  [&](const std::ptrdiff_t* nodes, std::size_t n, const PartedParticle<D, Lanes>& particles) {
                    const auto [weight, moment] = EdgeSums<D>::share(particles, size);
                    for (std::size_t l = 0; l < n; ++l) {
                      sums[nodes[l]].weight += weight[l];
                      sums[nodes[l]].moment += moment[l];
                    }
                  });
}

/// The same with the weights of any interpolator.
template <int D>
void add_regression(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                    const ContactPlane<D>* planes, RegressionSums<D>* sums);
template <int D>
void add_edges(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
               const ContactPlane<D>* planes, EdgeSums<D>* sums);

}  // namespace tamp::components
