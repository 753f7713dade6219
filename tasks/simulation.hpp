#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/engine.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/fields/field_copy.hpp"
#include "tasks/energy_ledger.hpp"
#include "tasks/labels.hpp"
#include "tasks/monitors.hpp"
#include "tasks/report/report.hpp"
#include "tasks/scene.hpp"
#include "tasks/step_records.hpp"
#include "tasks/step_totals.hpp"

namespace tamp::tasks
{

/// Memory of a particle [bytes].
struct ParticleBytes {
  /// Data that a step leaves to the next.
  std::size_t state = 0;
  /// The state as it is stored: twice where a step makes it anew.
  std::size_t kept_state = 0;
  /// All arrays, with those that live within a step.
  std::size_t all = 0;
};

/// Contact on a material: the force [N], and of a rigid body the torque about its centre of mass [N m].
struct ContactForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

/// Mean forces over a time, by material.
struct MeanForces {
  std::vector<ContactForce> contact;
  /// Forces of pressure loads [N].
  std::vector<Eigen::Vector3d> loads;
};

/// Changes the tasks of a step before they become its graph, so that they can be measured.
using ChangeStep = std::function<void(runtime::TaskList& step)>;

/// A scene in time. Made with all particles in place; each `advance` is one time step. Over several ranks every call is
/// collective unless it says otherwise, and what it returns is the same on all of them.
class Simulation
{
 public:
  /// The scene is kept. `n_threads` includes the caller.
  static std::unique_ptr<Simulation> make(Scene scene, int n_threads);
  /// On an executor that several simulations may share, as long as they advance in turn, and over the ranks of a
  /// communicator.
  static std::unique_ptr<Simulation> make(Scene scene, std::shared_ptr<runtime::Executor> executor,
                                          const runtime::Communicator& communicator = {},
                                          const ChangeStep& change = {});
  virtual ~Simulation() = default;

  const Scene& scene() const { return scene_; }
  /// Runs the steps: checkpoints, requests of the host, load balance and the profile are its.
  runtime::Engine& engine() { return *engine_; }
  const runtime::Engine& engine() const { return *engine_; }
  int n_threads() const { return executor_->n_threads(); }
  const runtime::Communicator& communicator() const { return engine_->communicator(); }

  long n_steps() const { return engine_->progress().n_steps; }
  double time() const { return engine_->progress().time; }
  double last_step_size() const { return engine_->progress().step_size; }
  /// The longest next step that is stable, before the multiplier [s].
  double stable_step() const { return warehouse().global_state(longest_step).size; }
  const EnergyLedger& energies() const { return warehouse().global_state(energy_ledger); }
  /// Stress updates of all materials since the start.
  const components::UpdateCounts& updates() const { return warehouse().total(step_totals).updates; }
  /// Sums over the nodes since the start.
  const GridTotals& grid_totals() const { return warehouse().total(tasks::grid_totals); }
  /// Particles lost since the start.
  const LostParticles& lost() const { return warehouse().total(lost_particles); }

  /// Records of what set the lengths of the steps since the start.
  const StepRecords& step_records() const { return warehouse().global_state(tasks::step_records); }
  /// Attempted steps that were refused since the start.
  const Occurrences& refused() const { return warehouse().global_state(refused_steps); }

  /// Records of the samples since the start, one every so many steps of the scene.
  const MonitorRecords& monitors() const { return warehouse().global_state(monitor_records); }

  /// Takes one step, as long as stability allows and not past `end` [s]. If it goes wrong (a particle inverts, a state
  /// is not finite, a material cannot be updated or grows too stiff), the state before it is kept and a shorter step is
  /// tried, as often as the scene allows. After the last of these, and where the time step falls below the scene's
  /// minimum, throws SimulationError; the state of the last good step is still there. An error on one rank is thrown on
  /// all.
  void advance(double end);
  ParticleReport report();
  /// Peaks near noses in the last report; those of no particle where the scene has no nose.
  NoseReport nose_peaks() const;
  /// Mean forces since the last call, or the start, each to the middle of the last step, where velocities are; not
  /// collective, but to be called by all ranks alike.
  MeanForces take_mean_forces();

  /// Particles of a material now, on all ranks.
  std::size_t n_particles(int material) const;
  /// A copy of the chosen fields of particles, and if asked for of nodes, this rank's part.
  virtual runtime::FieldCopy fields(const FieldChoice& choice, bool with_nodes) = 0;
  /// All fields, this rank's part, valid until they are asked for again.
  std::vector<runtime::ParticleBlock> particle_columns() { return (particles_ = fields({}, false)).particles; }
  /// A hash of every particle's state in the order of their ids, for all materials; 16 hexadecimal digits.
  std::string digest();

  /// The memory of fields on all ranks, as particles start [bytes].
  std::size_t forecast_bytes() const { return forecast_bytes_; }
  /// Bytes of the particle arrays that a step must at least read and write, per particle of a material.
  std::size_t least_bytes_per_particle(int material) const;
  /// Memory of a particle of a material.
  ParticleBytes particle_bytes(int material) const;

 protected:
  Simulation(Scene scene, std::shared_ptr<runtime::Executor> executor)
      : scene_(std::move(scene)), executor_(std::move(executor))
  {
  }

  runtime::Warehouse& warehouse() const { return engine_->warehouse(); }

  Scene scene_;
  std::shared_ptr<runtime::Executor> executor_;
  std::unique_ptr<runtime::Engine> engine_;
  std::size_t forecast_bytes_ = 0;

 private:
  double next_step_size() const;
  double shorter_step(double refused_size, int n_tries) const;
  void note_refusal();
  void note_step(const StepBound& bound, bool is_redone);
  void sample_state();
  /// Samples the contact of the next step, before it is taken.
  void sample_contact(double step_size);

  /// The columns that were last asked for.
  runtime::FieldCopy particles_;
};

}  // namespace tamp::tasks
