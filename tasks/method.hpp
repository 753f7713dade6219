#pragma once

#include <array>
#include <optional>
#include <span>

#include "components/contact/friction_table.hpp"
#include "components/loads/artificial_viscosity.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/tensors.hpp"
#include "runtime/data/views.hpp"
#include "runtime/graph/declaration.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The entries of a scene's triple that a method of this dimension uses.
template <int D>
Vector<D> vector_of(const Triple& triple)
{
  return Eigen::Map<const Vector<D>>(triple.data());
}

/// What the phases of a step need to know of a scene, typed by its interpolator and so by its dimension.
template <class Interpolator_>
struct Method {
  using Interpolator = Interpolator_;
  static constexpr int dimension = Interpolator::dimension;

  /// `scene` must outlive the method.
  explicit Method(const Scene& scene);

  Interpolator interpolator;
  double cell_size;
  /// Nodes with less mass [kg] are not accelerated: they are touched by an edge of a particle to within round-off, and
  /// as force goes with the slope of the weight but mass with its square, they would turn round-off into finite strain.
  double least_node_mass;
  Vector<dimension> gravity;
  /// Faces of the domain that mirror, as [axis][side]: side 0 is the lower.
  std::array<std::array<bool, 2>, std::size_t{dimension}> mirrors;
  std::optional<components::ArtificialViscosity> viscosity;
  StepRule time_step_rule;
  /// On the bounds of the viscous rule; the published rule has none.
  double step_factor;
  components::FrictionTable friction;
  std::span<const SceneMaterial> materials;
};

/// The nodes of a view as the kernels of components see them.
template <int D, class T>
components::GridBlock<D> block_of(const runtime::PatchLayout& layout, const runtime::GridView<T>& view)
{
  components::GridBlock<D> block;
  block.cell_size = layout.grid().cell_size;
  for (std::size_t k = 0; k < D; ++k) {
    const int axis = static_cast<int>(k);
    block.origin[axis] = layout.grid().coordinate(axis, view.box().lower[k]);
    block.n_nodes[k] = view.box().extent(axis);
    block.strides[k] = view.strides()[k];
  }
  return block;
}

}  // namespace tamp::tasks
