#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "runtime/data/memory_ledger.hpp"
#include "runtime/engine.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/graph/task_graph.hpp"
#include "runtime/profile/profiler.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/checkpoints/checkpoint.hpp"
#include "runtime/storage/fields/field_copy.hpp"
#include "tasks/energy_ledger.hpp"
#include "tasks/labels.hpp"
#include "tasks/report/report.hpp"
#include "tasks/rigid_body.hpp"
#include "tasks/scene.hpp"
#include "tasks/step_totals.hpp"

namespace tamp::tasks
{

/// Patches dealt anew to the ranks before a step. An imbalance is the load of the busiest rank over the mean.
struct Rebalance {
  long step = 0;
  double imbalance_before = 1;
  double imbalance_expected = 1;
  /// Measured over the steps that followed; 0 before there were enough.
  double imbalance_got = 0;
};

/// Bytes that a particle takes.
struct ParticleBytes {
  /// What a step leaves to the next.
  std::size_t state = 0;
  /// The same as it is kept: twice where a step makes it anew.
  std::size_t kept_state = 0;
  /// All arrays, with those that live within a step.
  std::size_t all = 0;
};

/// What contact does to a material: the force [N], and of a rigid body the torque about its centre of mass [N m].
struct ContactForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

/// By material, means over a time.
struct MeanForces {
  std::vector<ContactForce> contact;
  /// By pressure loads [N].
  std::vector<Eigen::Vector3d> loads;
};

/// A scene in time. Made with all particles in place; each `advance` is one time step. Over several ranks every call is
/// collective unless it says otherwise, and what it returns is the same on all of them.
///
/// Errors: `advance` throws SimulationError when a particle inverts, a state is not finite, a material cannot be
/// updated, or the time step falls below the scene's minimum; the state of the last good step is then still there. An
/// error on one rank is thrown on all.
class Simulation
{
 public:
  /// The scene is kept. `n_threads` includes the caller.
  static std::unique_ptr<Simulation> make(Scene scene, int n_threads);
  /// On an executor that several simulations may share, as long as they advance in turn, and over the ranks of a
  /// communicator.
  static std::unique_ptr<Simulation> make(Scene scene, std::shared_ptr<runtime::Executor> executor,
                                          const runtime::Communicator& communicator = {});
  virtual ~Simulation() = default;

  const Scene& scene() const { return scene_; }
  long n_steps() const { return n_steps_; }
  double time() const { return time_; }
  double last_step_size() const { return last_step_size_; }
  int n_threads() const { return executor_->n_threads(); }
  const runtime::Communicator& communicator() const { return communicator_; }
  /// The longest next step that is stable, before the multiplier [s].
  double stable_step() const { return warehouse().global_state(longest_step); }
  const EnergyLedger& energies() const { return warehouse().global_state(energy_ledger); }
  /// Stress updates of all materials since the start.
  const components::UpdateCounts& updates() const { return warehouse().total(step_totals).updates; }
  /// Sums over the nodes since the start.
  const GridTotals& grid_totals() const { return warehouse().total(tasks::grid_totals); }
  /// Since the start.
  const LostParticles& lost() const { return warehouse().total(lost_particles); }

  /// Those since the last call, or the start; not collective, but to be called by all ranks alike.
  MeanForces take_mean_forces();

  /// Bits that this rank tells all ranks with the next step; not collective. A rank without patches is not heard.
  void ask(unsigned requests) { requests_ |= requests; }
  /// What any rank asked for in the last step.
  unsigned asked() const { return asked_; }
  /// How many steps there are between two looks at the load of the ranks; 0: patches stay where they are.
  void balance_every(long n_steps) { balance_interval_ = n_steps; }
  const std::vector<Rebalance>& rebalances() const { return rebalances_; }

  /// One step, as long as stability allows and not past `end` [s].
  virtual void advance(double end) = 0;
  virtual ParticleReport report() = 0;
  /// Peaks near noses in the last report; those of no particle where the scene has no nose.
  virtual NoseReport near_noses() const = 0;

  virtual const runtime::TaskGraph& graph() const = 0;
  /// This rank's.
  virtual const runtime::MemoryLedger& ledger() const = 0;
  /// The memory of fields on all ranks [bytes].
  virtual std::size_t forecast_bytes() const = 0;
  virtual runtime::Profile profile() const = 0;
  /// Of the first steps, as many as `trace_steps` asked for before them: none if it was not called.
  virtual runtime::Trace trace() const = 0;
  virtual void trace_steps(long n_steps) = 0;
  /// Off only to measure what recording costs.
  virtual void record(bool on) = 0;

  /// Particles of a material now, on all ranks.
  virtual std::size_t n_particles(int material) const = 0;
  /// A copy of the chosen fields of particles, and if asked for of nodes, this rank's part.
  virtual runtime::FieldCopy fields(const FieldChoice& choice, bool with_nodes) = 0;
  /// All fields, this rank's part, valid until they are asked for again.
  std::vector<runtime::ParticleBlock> particle_columns() { return (particles_ = fields({}, false)).particles; }
  runtime::NodeBlock node_columns() { return (nodes_ = fields({}, true)).nodes.value(); }
  /// Keeps the state in a folder, with bytes of the host's own, which are the same on all ranks; see
  /// runtime::write_checkpoint. Throws FileError.
  virtual void write_checkpoint(const std::filesystem::path& folder, const std::string& fingerprint,
                                std::span<const std::byte> host, int keep) = 0;
  /// The same in two parts: a copy, on the first rank, which that rank may write when and in which thread it likes.
  virtual runtime::CheckpointCopy copy_checkpoint(const std::string& fingerprint, std::span<const std::byte> host) = 0;
  /// Goes on where a checkpoint of the same scene was written, on any ranks; returns the host's bytes.
  virtual std::vector<std::byte> restart(const runtime::FoundCheckpoint& found) = 0;
  /// A hash of every particle's state in the order of their ids, for all materials; 16 hexadecimal digits.
  virtual std::string digest() = 0;
  /// Bytes of the particle arrays that a step must at least read and write, per particle of a material.
  virtual std::size_t least_bytes_per_particle(int material) const = 0;
  /// What a particle of a material takes in memory.
  virtual ParticleBytes particle_bytes(int material) const = 0;

 protected:
  Simulation(Scene scene, std::shared_ptr<runtime::Executor> executor, const runtime::Communicator& communicator)
      : scene_(std::move(scene)), executor_(std::move(executor)), communicator_(communicator)
  {
  }

  runtime::Warehouse& warehouse() const { return engine_->warehouse(); }

  Scene scene_;
  std::shared_ptr<runtime::Executor> executor_;
  runtime::Communicator communicator_;
  unsigned requests_ = 0;
  unsigned asked_ = 0;
  long balance_interval_ = 0;
  std::vector<Rebalance> rebalances_;
  long n_steps_ = 0;
  double time_ = 0;
  double last_step_size_ = 0;
  std::unique_ptr<runtime::Engine> engine_;
  /// Last asked for.
  runtime::FieldCopy particles_;
  runtime::FieldCopy nodes_;
};

}  // namespace tamp::tasks
