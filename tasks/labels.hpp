#pragma once

#include <cstdint>
#include <tuple>

#include "components/anti_locking/cell_average.hpp"
#include "components/contact/logistic_plane.hpp"
#include "components/contact/normals.hpp"
#include "components/contact/solid_contact.hpp"
#include "components/contact/wall_gaps.hpp"
#include "components/loads/pressure_load.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/tensors.hpp"
#include "runtime/data/label.hpp"
#include "tasks/energy_ledger.hpp"
#include "tasks/occurrences.hpp"
#include "tasks/rigid_body.hpp"
#include "tasks/step_records.hpp"
#include "tasks/step_totals.hpp"

/// Every field of the method, by where it lives. SI units, tension positive unless the name says otherwise; in plane
/// strain masses, volumes and energies are those of a slab 1 m thick, in axisymmetric scenes those of whole rings.
namespace tamp::tasks
{

namespace particle
{

/// Number in the scene, from 0, the same for any cut into patches.
inline const runtime::ParticleLabel<std::int64_t, "id"> id;
/// The particle's body, as its index in the scene's list.
inline const runtime::ParticleLabel<std::int64_t, "body"> body;
/// Position of the particle at the start [m].
template <int D>
inline const runtime::ParticleLabel<Vector<D>, "reference position"> reference_position;
inline const runtime::ParticleLabel<double, "mass"> mass;
/// Where the grid is periodic: how often the particle has left at the upper end of each axis, less how often at the
/// lower.
inline const runtime::ParticleLabel<runtime::Index, "laps"> laps;
template <int D>
inline const runtime::ParticleLabel<Vector<D>, "position"> position;
/// Velocity [m/s] at the middle of the last step: half a step behind the position (leapfrog).
template <int D>
inline const runtime::ParticleLabel<Vector<D>, "velocity"> velocity;
/// Velocity gradient [1/s] at the middle of the last step; row: component of velocity. Only where the transfer needs
/// it.
template <int D>
inline const runtime::ParticleLabel<Matrix<D>, "velocity gradient"> velocity_gradient;
/// sum S_ip v_i (x) (x_i - x_p) in the last step [m^2/s]; row: component of velocity. Only where the transfer needs it.
template <int D>
inline const runtime::ParticleLabel<Matrix<D>, "velocity moment"> velocity_moment;
template <int D>
inline const runtime::ParticleLabel<Matrix<D>, "deformation gradient"> deformation_gradient;
/// Length of the particle's ring over that at the start. Only in axisymmetric scenes.
inline const runtime::ParticleLabel<double, "hoop stretch"> hoop_stretch;
inline const runtime::ParticleLabel<double, "volume"> volume;
/// Cauchy stress [Pa].
template <int D>
inline const runtime::ParticleLabel<SymmetricTensor<D>, "stress"> stress;
/// The part of the pressure that is artificial viscosity [Pa], compression positive.
inline const runtime::ParticleLabel<double, "viscous pressure"> viscous_pressure;
/// The state that a material model keeps for each particle; only for models that have one.
template <class Model>
inline const runtime::ParticleLabel<typename Model::State, Model::state_name> state;
/// Gaps between grains, as a volumetric strain, see components::Gaps. Only for soil that has them.
inline const runtime::ParticleLabel<double, "opening"> opening;
/// Stiffness that the particle gives its nodes in this step, see components::own_stiffness; 0 where the rule for the
/// time step does not use it.
inline const runtime::ParticleLabel<double, "own stiffness"> own_stiffness;
/// Strain increment of this step, in the frame at its end.
template <int D>
inline const runtime::ParticleLabel<SymmetricTensor<D>, "strain increment"> strain_increment;
/// dt times the gradient of the velocity in this step; row: component of velocity. Only where particles deform as their
/// cells do.
template <int D>
inline const runtime::ParticleLabel<Matrix<D>, "step gradient"> step_gradient;
/// dt v_r / r of the particle's ring in this step. Only in axisymmetric scenes whose particles deform as their cells
/// do.
inline const runtime::ParticleLabel<double, "step hoop"> step_hoop;
/// Stress of a particle for the forces at nodes [Pa]: its mean is that of its cell. Only where particles deform as
/// their cells do.
template <int D>
inline const runtime::ParticleLabel<SymmetricTensor<D>, "shared stress"> shared_stress;

}  // namespace particle

namespace cell
{

/// Only where particles deform as their cells do: det f - 1, of rings with the hoop's stretch, and
/// components::mean_stress [Pa].
inline const runtime::CellLabel<components::CellMean, "volume change of cells"> volume_change;
inline const runtime::CellLabel<components::CellMean, "mean stress of cells"> mean_stress;
/// Mean pressure of the particles in a cell [Pa], compression positive; for samples of the state.
inline const runtime::CellLabel<components::CellMean, "pressure of cells"> pressure;

}  // namespace cell

namespace node
{

template <int D>
inline const runtime::NodeLabel<components::NodeSums<D>, "node sums"> sums;
template <int D>
inline const runtime::NodeLabel<components::NodeMotion<D>, "node motion"> motion;
/// Sums of particles' velocities for the gradients that deform them, and the nodes' velocities by these. Only where
/// particles do not deform by the velocities that move them.
template <int D>
inline const runtime::NodeLabel<components::NodeSums<D>, "carried sums"> carried_sums;
template <int D>
inline const runtime::NodeLabel<components::NodeMotion<D>, "carried motion"> carried_motion;
/// Inverse of the nodal mass [1/kg]; 0 at nodes with next to no mass.
inline const runtime::NodeLabel<double, "inverse mass"> inverse_mass;
/// Sums of pressure loads. Only for materials with a body under a pressure load.
template <int D>
inline const runtime::NodeLabel<components::PressureSums<D>, "pressure sums"> pressure_sums;
/// Body force at a node [N]. Only for materials with a body force.
template <int D>
inline const runtime::NodeLabel<components::NodeVector<D>, "body force"> body_force;
template <int D>
inline const runtime::NodeLabel<components::ContactPlane<D>, "contact plane"> contact_plane;
/// Summed anew in each pass over the particles that turns the planes.
template <int D>
inline const runtime::NodeLabel<components::RegressionSums<D>, "regression sums"> regression_sums;
template <int D>
inline const runtime::NodeLabel<components::EdgeSums<D>, "edge sums"> edge_sums;
/// Plane of contact at a node. Only where a contact finds planes by a pass of its own.
template <int D>
inline const runtime::NodeLabel<components::ContactFace<D>, "contact face"> contact_face;
/// Sums of gaps to rigid bodies. Only for materials that meet a rigid body by its solid.
template <int D>
inline const runtime::NodeLabel<components::GapSums<D>, "gap sums"> gap_sums;
/// Gaps to walls. Only where the grid has walls that matter touches at its edges.
template <int D>
inline const runtime::NodeLabel<components::WallGaps<D>, "wall gaps"> wall_gaps;
/// The last term u_j of a transfer's passes, and the sum of those that the transfer takes [m/s].
template <int D>
inline const runtime::NodeLabel<components::NodeVector<D>, "velocity term"> velocity_term;
template <int D>
inline const runtime::NodeLabel<components::NodeVector<D>, "velocity terms"> velocity_terms;
/// sum m_p S_ip (S u)_p [kg m/s], anew in each pass.
template <int D>
inline const runtime::NodeLabel<components::NodeVector<D>, "returned momentum"> returned_momentum;

}  // namespace node

/// Accumulated from the start: what a step adds to the energies, and how long the next may be.
inline const runtime::ReductionLabel<StepTotals, "step totals"> step_totals;
/// The part of the step totals that contact by solids adds.
inline const runtime::ReductionLabel<StepTotals, "totals of solids"> solid_totals;
inline const runtime::ReductionLabel<GridTotals, "grid totals"> grid_totals;
inline const runtime::ReductionLabel<LostParticles, "lost particles"> lost_particles;
/// Work of body forces, where a scene has any.
inline const runtime::ReductionLabel<BodyForceWork, "body force work"> body_force_work;
/// Impulses accumulated since the host last took their means, from the middle of the step before, `forces_taken_at`
/// [s]; loads only where a scene has any.
inline const runtime::ReductionLabel<ContactImpulses, "contact impulses"> contact_impulses;
inline const runtime::ReductionLabel<LoadTotals, "load totals"> load_totals;
inline const runtime::GlobalLabel<double, "forces taken at"> forces_taken_at;
inline const runtime::ReductionLabel<RigidCouplings, "rigid couplings"> rigid_couplings;

/// Energies since the start.
inline const runtime::GlobalLabel<EnergyLedger, "energy ledger"> energy_ledger;
inline const runtime::GlobalLabel<StepBound, "longest step"> longest_step;
/// Records of what set the lengths of the steps since the start.
inline const runtime::GlobalLabel<StepRecords, "step records"> step_records;
/// Attempted steps that were refused since the start.
inline const runtime::GlobalLabel<Occurrences, "refused steps"> refused_steps;

/// Where rigid bodies are and how they move; like the velocities of particles, their momenta are half a step behind.
inline const runtime::GlobalLabel<RigidStates, "rigid states"> rigid_states;
/// The rigid states at the start of the step, with the momenta that body forces alone give them in it.
inline const runtime::GlobalLabel<RigidStates, "free rigid states"> free_rigid_states;

}  // namespace tamp::tasks
