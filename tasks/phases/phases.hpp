#pragma once

#include "runtime/graph/declaration.hpp"
#include "tasks/method.hpp"

/// The phases of a time step, each declared in the file of its name: its tasks, or none where a scene does not need it.
/// `method` must outlive the tasks.
namespace tamp::tasks
{

/// Particles share the mean stress of their cell, by which they will push on nodes.
template <int D>
runtime::TaskList share_stress(const Method<D>& method);

/// Particles give their mass, momentum and forces to the grid.
template <int D>
runtime::TaskList particles_to_grid(const Method<D>& method);

/// Pressure loads push on the nodes of the surfaces that they act on.
template <int D>
runtime::TaskList press(const Method<D>& method);

/// Body forces of the scene's problems add to the forces on nodes.
template <int D>
runtime::TaskList body_force(const Method<D>& method);

/// Work of the body forces in the step, once particles have moved.
template <int D>
runtime::TaskList work_of_body_force(const Method<D>& method);

/// Nodes of deformable materials are accelerated by their forces, gravity and what the turning of the frame adds. The
/// inverses of their masses are for those who ask.
template <int D>
runtime::TaskList accelerate_nodes(const Method<D>& method, bool computes_inverse_mass);

/// Rigid bodies are accelerated by gravity and what the turning of the frame adds.
template <int D>
runtime::TaskList accelerate_rigid_bodies(const Method<D>& method);

/// Nodes of materials that are rigid bodies move as they would without contact.
template <int D>
runtime::TaskList rigid_nodes_before_contact(const Method<D>& method);

/// Contact normals by regression: planes are laid between the particles of two materials, which then face each other
/// along the planes' normals where they touch, and nowhere else.
template <int D>
runtime::TaskList contact_planes(const Method<D>& method);

/// Contact of rigid bodies, for their motion.
template <int D>
runtime::TaskList gather_rigid_contact(const Method<D>& method);

/// Contact of rigid bodies with what meets them by their solids: the gaps between both, and what it is for the bodies'
/// motion.
template <int D>
runtime::TaskList gather_contact_of_solids(const Method<D>& method);

/// The nodes of rigid bodies move as these do after contact.
template <int D>
runtime::TaskList rigid_nodes_after_contact(const Method<D>& method);

/// Where materials meet at a node and approach each other, impulses keep them apart.
template <int D>
runtime::TaskList contact(const Method<D>& method);

/// Where a gap between a material and a rigid body's solid would close within the step, impulses leave nothing of it.
template <int D>
runtime::TaskList contact_of_solids(const Method<D>& method);

/// The gaps between matter and walls that it touches at its edges.
template <int D>
runtime::TaskList find_wall_gaps(const Method<D>& method);

/// Nothing crosses a wall of the domain.
template <int D>
runtime::TaskList walls(const Method<D>& method);

/// Impulses of pressure loads on the materials, and their work.
template <int D>
runtime::TaskList account_for_pressure(const Method<D>& method);

/// Rigid bodies take what contact gave them, and move.
template <int D>
runtime::TaskList move_rigid_bodies(const Method<D>& method);

/// The particles of rigid bodies move with them; bounds the next step.
template <int D>
runtime::TaskList move_rigid_particles(const Method<D>& method);

/// Passes of velocities from nodes to particles and back, as many as the transfer has; empty for most.
template <int D>
runtime::TaskList pass_velocities(const Method<D>& method);

/// Particles of the other materials are moved by the grid, and deformed where no other velocities do that.
template <int D>
runtime::TaskList grid_to_particles(const Method<D>& method);

/// Particles bring their velocities to the nodes, and are deformed by what these come to there.
template <int D>
runtime::TaskList deform_by_carried_velocities(const Method<D>& method);

/// Where all particles of a cell share its change of volume, they are deformed by a phase of its own.
template <int D>
runtime::TaskList deform_as_cells(const Method<D>& method);

/// Particles deform, where moving them has not done that, and their materials answer with stress; sums energies and
/// bounds the next step. Either at the start of the step or at its end, as the scene has it.
template <int D>
runtime::TaskList update_stress_first(const Method<D>& method);
template <int D>
runtime::TaskList update_stress_last(const Method<D>& method);

/// Particles that leave the grid, which nothing is known of after the step.
template <int D>
runtime::TaskList count_lost(const Method<D>& method);

/// Where the energy has gone by the end of the step, and how long the next may be. Throws SimulationError where more
/// stress updates have failed than the scene allows; particles do not move to other patches before.
template <int D>
runtime::TaskList account_for_step(const Method<D>& method);

}  // namespace tamp::tasks
