#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "components/contact/contact_table.hpp"
#include "components/contact/wall_gaps.hpp"
#include "components/geometry/fill.hpp"
#include "components/loads/artificial_viscosity.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/tensors.hpp"
#include "runtime/data/views.hpp"
#include "runtime/graph/declaration.hpp"
#include "tasks/rigid_body.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The entries of a scene's triple that a method of this dimension uses.
template <int D>
Vector<D> vector_of(const Triple& triple)
{
  return Eigen::Map<const Vector<D>>(triple.data());
}

/// A vector of the method among those of space; the plane is that of x and y.
template <int D>
Eigen::Vector3d in_space(const Vector<D>& v)
{
  Eigen::Vector3d padded = Eigen::Vector3d::Zero();
  padded.head<D>() = v;
  return padded;
}

/// Position of a node [m].
template <int D>
Vector<D> node_position(const runtime::Grid& grid, const runtime::Index& node)
{
  Vector<D> x;
  for (int k = 0; k < D; ++k) x[k] = grid.coordinate(k, node[static_cast<std::size_t>(k)]);
  return x;
}

/// The sites where the particles of a material start.
template <int D>
components::ParticleLattice<D> lattice_of(const Scene& scene, int material)
{
  return {vector_of<D>(scene.grid.lower), scene.grid.cell_size, scene.particles_per_axis_of(material)};
}

/// The parts of a scene that the phases of a step need.
template <int D>
struct Method {
  /// `scene` must outlive the method.
  explicit Method(const Scene& scene);

  /// The interpolation for a material's particles.
  const components::Interpolation<D>& interpolation(int material) const
  {
    return *interpolations[static_cast<std::size_t>(material)];
  }
  /// Calls `visit(transfer)` with that of the scene, see components/transfers/.
  template <class Visit>
  auto with_transfer(Visit&& visit) const
  {
    return components::with_transfer(scene.transfer, scene.transfer_numbers, std::forward<Visit>(visit));
  }
  /// Whether contact or a pressure load asks where the surface of a material is.
  bool needs_surface_of(int material) const;
  /// The rigid body that a material is, or null.
  const RigidBody* rigid_body(int material) const;

  const Face& face(const components::PlaneWall& wall) const
  {
    return scene.faces[static_cast<std::size_t>(wall.axis)][wall.outside < 0 ? 0 : 1];
  }

  /// Whether a material meets the surface of a rigid body's solid.
  bool meets_by_solid(const RigidBody& body, int material) const;

  /// Whether particles deform by other velocities than those of the nodes that their forces work on. The energy of a
  /// step is then balanced as a whole.
  bool deforms_by_other_velocities() const
  {
    return stress_timing != StressTiming::usl || (passes == components::Passes::from_end && n_passes > 0);
  }

  /// Whether particles carry gradients, or moments, to the grid beside their velocities.
  bool brings_gradients() const { return carried_gradient == components::CarriedGradient::gradient; }
  bool brings_moments() const { return carried_gradient == components::CarriedGradient::moment; }

  /// Materials that are a rigid body.
  std::vector<int> rigid_materials() const;

  /// Whether the particles of a cell share the changes of its volume and the stress that works against them.
  bool deforms_as_cells() const { return anti_locking == AntiLocking::cell_average && !deformable_materials.empty(); }

  /// Work of gravity and a steady centrifuge on matter from the origin to x, per mass [J/kg]. A centrifuge that speeds
  /// up has no such function, and is left out.
  double work_function(const Vector<D>& x) const;
  /// Whether that is 0 everywhere.
  bool is_weightless() const { return gravity.isZero(0) && !(centrifuge && centrifuge->is_steady()); }

  const Scene& scene;
  std::vector<std::unique_ptr<const components::Interpolation<D>>> interpolations;
  /// Layers of nodes beyond a patch that its particles reach.
  int halo;
  components::CarriedGradient carried_gradient;
  /// Passes of nodes -> particles -> nodes: from which velocities, and how many.
  components::Passes passes;
  int n_passes;
  /// The transfer's amplification of the motion of nodes, for the bound on the step.
  double amplification;
  DeformationUpdate deformation_update;
  AntiLocking anti_locking;
  StressTiming stress_timing;
  bool axisymmetric;
  double cell_size;
  /// Nodes with less mass [kg] are not accelerated: they are touched by an edge of a particle to within round-off, and
  /// as force goes with the slope of the weight but mass with its square, they would turn round-off into finite strain.
  double least_node_mass;
  Vector<D> gravity;
  /// In three dimensions only.
  std::optional<components::RotatingFrame> centrifuge;
  /// Faces of the domain that are walls with a mirror image behind them, as [axis][side]: side 0 is the lower.
  std::array<std::array<bool, 2>, std::size_t{D}> mirrors;
  /// Walls that matter touches at its edges, and those with an image behind them.
  std::vector<components::PlaneWall> edge_walls, image_walls;
  std::optional<components::ArtificialViscosity> viscosity;
  /// The part of unbalanced forces that local damping takes.
  double damping;
  StepRule time_step_rule;
  components::ContactTable contacts;
  std::span<const SceneMaterial> materials;
  /// Their mass is that of their particles, which the simulation fills in.
  std::vector<RigidBody> rigid_bodies;
  /// The surfaces of the rigid bodies, in the same order, as they lie at the start; those beside a plane of symmetry
  /// with their images.
  std::vector<components::Solid<D>> solids;
  /// Materials that meet a rigid body by its solid.
  std::vector<int> touch_solids;
  /// Materials that are no rigid body.
  std::vector<int> deformable_materials;
  /// Materials with a body under a pressure load.
  std::vector<int> pressed_materials;
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
