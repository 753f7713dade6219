#pragma once

#include <vector>

#include "runtime/graph/declaration.hpp"
#include "tasks/method.hpp"

/// The phases of a time step, each declared in the file of its name. `method` must outlive the tasks.
namespace tamp::tasks
{

/// Particles give their mass, momentum and forces to the grid.
template <class Interpolator>
runtime::TaskDeclaration particles_to_grid(const Method<Interpolator>& method);

/// Nodes of deformable materials are accelerated by their forces, gravity and what the turning of the frame adds.
template <class Interpolator>
runtime::TaskDeclaration accelerate_nodes(const Method<Interpolator>& method);

/// Nodes of the material that is a rigid body move as it would without contact.
template <class Interpolator>
runtime::TaskDeclaration release_rigid_nodes(const Method<Interpolator>& method, int material);

/// Of pairs whose normal comes by regression: planes are laid between their particles, and the materials face each
/// other along the planes' normals where they touch, and nowhere else.
template <class Interpolator>
std::vector<runtime::TaskDeclaration> part_materials(const Method<Interpolator>& method);

/// What the contact of rigid bodies asks of their motion.
template <class Interpolator>
runtime::TaskDeclaration gather_rigid_contact(const Method<Interpolator>& method);

/// The nodes of rigid bodies move as these do after contact.
template <class Interpolator>
runtime::TaskDeclaration move_rigid_nodes(const Method<Interpolator>& method);

/// Where materials meet at a node and approach each other, impulses keep them apart.
template <class Interpolator>
runtime::TaskDeclaration contact(const Method<Interpolator>& method);

/// Nothing crosses a mirroring face of the domain.
template <class Interpolator>
runtime::TaskDeclaration symmetry_walls(const Method<Interpolator>& method);

/// The particles of a material that is a rigid body move with it; bounds the next step.
template <class Interpolator>
runtime::TaskDeclaration move_rigid_body(const Method<Interpolator>& method, int material);

/// Particles of the other materials are moved and deformed by the grid.
template <class Interpolator>
runtime::TaskDeclaration grid_to_particles(const Method<Interpolator>& method);

/// The material answers the deformation of its particles with stress; sums energies and bounds the next step.
template <class Interpolator>
runtime::TaskDeclaration update_stress(const Method<Interpolator>& method, int material);

}  // namespace tamp::tasks
