#include "tasks/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "components/loads/time_step.hpp"
#include "components/materials/wave_speed.hpp"
#include "runtime/data/byte_stream.hpp"
#include "runtime/execute/move_patches.hpp"
#include "runtime/execute/on_workers.hpp"
#include "runtime/grid/curve_order.hpp"
#include "runtime/ranks/deal_patches.hpp"
#include "runtime/ranks/load_balance.hpp"
#include "tasks/common_failure.hpp"
#include "tasks/graphs.hpp"
#include "tasks/labels.hpp"
#include "tasks/report/field_columns.hpp"
#include "tasks/report/state_digest.hpp"
#include "tasks/set_up/deformed_start.hpp"
#include "tasks/set_up/fill_bodies.hpp"
#include "tasks/set_up/initial_moduli.hpp"
#include "tasks/set_up/settled_sand.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

namespace
{

std::vector<std::string> material_names(const Scene& scene)
{
  std::vector<std::string> names;
  for (const SceneMaterial& m : scene.materials) names.push_back(m.name);
  return names;
}

template <int D>
components::TangentModuli greatest_initial_moduli(const Scene& scene, const SceneBody& body)
{
  const SceneMaterial& material = scene.materials[static_cast<std::size_t>(body.material)];
  components::TangentModuli moduli = initial_moduli(material);
  if (body.functions.deformation_gradient) moduli = greatest_deformed_moduli<D>(scene, body);
  if (body.initial_stress) {
    const double ratio = moduli.shear_modulus / moduli.bulk_modulus;
    moduli.bulk_modulus = SettledSand<D>(scene, body).greatest_bulk_modulus();
    moduli.shear_modulus = ratio * moduli.bulk_modulus;
  }
  return moduli;
}

/// The patches dealt to the ranks by the particles that start on them.
runtime::PatchLayout dealt(const Scene& scene, const std::vector<double>& particles_per_patch, int n_ranks)
{
  runtime::PatchLayout layout(scene.grid, scene.n_patches);
  const std::vector<int> order = runtime::curve_order(scene.n_patches);
  layout.give_to_ranks(runtime::deal_patches(order, particles_per_patch, n_ranks), n_ranks);
  return layout;
}

template <int D>
class SimulationOf : public Simulation
{
 public:
  SimulationOf(Scene given, std::shared_ptr<runtime::Executor> executor, const runtime::Communicator& communicator)
      : Simulation(std::move(given), std::move(executor), communicator), method_(scene_)
  {
    const BodyParticles<D> particles(scene_, runtime::PatchLayout(scene_.grid, scene_.n_patches));
    engine_ = make_engine(dealt(scene_, particles.per_patch(), communicator.size()));
    particles.store(engine_->warehouse());
    make_rigid_bodies(particles);
    profiler_.emplace(engine_->schedule(step_graph), engine_->bound(step_graph), n_threads());
    forecast_bytes_ = communicator_.sum(engine_->warehouse().forecast_bytes());
    warehouse().global_state(longest_step) = initial_stable_step(particles);
    warehouse().global_state(energy_ledger).elastic = particles.stored_energy();
  }

  void advance(double end) override
  {
    balance_if_due();
    const double size = next_step_size(end);
    run_step({n_steps_, time_, size, last_step_size_, std::exchange(requests_, 0U)});
    engine_->warehouse().advance();
    if (engine_->schedule(step_graph).recording) profiler_->add_step();
    asked_ = engine_->warehouse().result(host_requests).bits;
    ++n_steps_;
    time_ = time_ + size >= end * (1 - 1e-14) ? end : time_ + size;
    last_step_size_ = size;
  }

  ParticleReport report() override
  {
    executor_->run(engine_->schedule(report_graph), {n_steps_, time_, 0, last_step_size_, 0});
    return engine_->warehouse().result(particle_report);
  }

  NoseReport near_noses() const override
  {
    return scene_.has_nose() ? engine_->warehouse().result(nose_report) : NoseReport{};
  }

  const runtime::TaskGraph& graph() const override { return engine_->graph(step_graph); }
  const runtime::MemoryLedger& ledger() const override { return engine_->warehouse().ledger(); }
  std::size_t forecast_bytes() const override { return forecast_bytes_; }
  runtime::Profile profile() const override { return profiler_->profile(communicator_); }
  runtime::Trace trace() const override { return profiler_->trace(communicator_); }
  void trace_steps(long n_steps) override { profiler_->trace_steps(n_steps); }
  void record(bool on) override { engine_->schedule(step_graph).recording = on; }
  std::size_t n_particles(int material) const override
  {
    return communicator_.sum(engine_->warehouse().n_particles(material));
  }
  runtime::FieldCopy fields(const FieldChoice& choice, bool with_nodes) override
  {
    return copy_of_fields(method_, choice, with_nodes, engine_->warehouse(), *executor_, communicator_);
  }
  void write_checkpoint(const std::filesystem::path& folder, const std::string& fingerprint,
                        std::span<const std::byte> host, int keep) override
  {
    runtime::write_checkpoint(folder, header(fingerprint), own_bytes(host), engine_->warehouse(),
                              material_names(scene_), keep, communicator_);
  }

  runtime::CheckpointCopy copy_checkpoint(const std::string& fingerprint, std::span<const std::byte> host) override
  {
    // The workers' run has a watch of its own; what follows it is messages.
    std::unique_ptr<runtime::Watchdog::Watch> watch;
    const auto for_all = [&](int n, const auto& work) {
      runtime::on_workers(*executor_, n, work);
      watch.reset(new runtime::Watchdog::Watch(executor_->watch("gathering the state")));
    };
    return runtime::copy_checkpoint(header(fingerprint), own_bytes(host), engine_->warehouse(), material_names(scene_),
                                    for_all, communicator_);
  }

  std::vector<std::byte> restart(const runtime::FoundCheckpoint& found) override
  {
    runtime::read_checkpoint(found, engine_->warehouse(), material_names(scene_), communicator_);
    n_steps_ = found.header.step;
    time_ = found.header.time;
    runtime::ByteReader own(found.host);
    own.read(last_step_size_);
    return {own.rest().begin(), own.rest().end()};
  }

  std::string digest() override { return state_digest(engine_->warehouse(), communicator_); }

  std::size_t least_bytes_per_particle(int material) const override
  {
    std::size_t bytes = 0;
    for (const runtime::Field* field : engine_->warehouse().particle_fields(0, material)) {
      if (field->state && used_in_step(*field->label)) bytes += field->label->value_bytes() * (field->carried ? 1 : 2);
    }
    return bytes;
  }

  ParticleBytes particle_bytes(int material) const override
  {
    ParticleBytes bytes;
    for (const runtime::Field* field : engine_->warehouse().particle_fields(0, material)) {
      const std::size_t once = field->label->value_bytes(), kept = once * (field->state && !field->carried ? 2 : 1);
      if (field->state) bytes.state += once;
      if (field->state) bytes.kept_state += kept;
      bytes.all += kept;
    }
    return bytes;
  }

 private:
  std::unique_ptr<runtime::Engine> make_engine(const runtime::PatchLayout& layout)
  {
    return std::make_unique<runtime::Engine>(layout, material_names(scene_), graphs_of(method_), n_threads(),
                                             communicator_);
  }

  runtime::CheckpointHeader header(const std::string& fingerprint) const { return {n_steps_, time_, fingerprint}; }

  /// What a checkpoint keeps of this object and of the host.
  std::vector<std::byte> own_bytes(std::span<const std::byte> host)
  {
    runtime::ByteWriter own;
    own.add(last_step_size_);
    own.add_bytes(host);
    return own.bytes();
  }

  void make_rigid_bodies(const BodyParticles<D>& particles)
  {
    RigidStates& states = engine_->warehouse().global_state(rigid_states);
    for (RigidBody& body : method_.rigid_bodies) {
      const SceneBody& given = scene_.bodies[static_cast<std::size_t>(body.body)];
      body.properties = particles.mass_properties(body.body);
      states.of(body) = initial_state(body.properties, in_space<D>(vector_of<D>(given.velocity)),
                                      Eigen::Vector3d(given.angular_velocity.data()));
    }
  }

  bool used_in_step(const runtime::Label& label) const
  {
    for (const runtime::TaskDeclaration& task : engine_->graph(step_graph).declarations()) {
      for (const runtime::Access& access : task.accesses) {
        if (access.label == &label) return true;
      }
    }
    return false;
  }

  double next_step_size(double end) const
  {
    const double size = std::min(scene_.time.multiplier * stable_step(), scene_.time.maximum_step);
    if (!(size >= scene_.time.minimum_step)) {
      throw SimulationError(
          fmt::format("the time step {:.3g} s is below the minimum of {:.3g} s", size, scene_.time.minimum_step), "",
          -1, {});
    }
    return std::min(size, end - time_);
  }

  /// The bound for a body by itself whose matter is no faster than `v` along any axis. Its nodes are not known yet, so
  /// that each particle may have its own to itself.
  double initial_stable_step(const SceneBody& body, const Vector<D>& v) const
  {
    const double h = method_.cell_size;
    if (body.rigid) return components::published_time_step<D>(h, 0, v);
    const auto [bulk, shear] = greatest_initial_moduli<D>(scene_, body);
    const double density = scene_.materials[static_cast<std::size_t>(body.material)].density;
    if (method_.time_step_rule == StepRule::published) {
      return components::published_time_step<D>(h, components::wave_speed(bulk, shear, density), v);
    }
    const double own_stiffness = method_.interpolation(body.material).greatest_own_stiffness();
    return components::viscous_time_step<D>(h, {density, bulk, shear, v, 0, own_stiffness},
                                            method_.viscosity.value_or(components::ArtificialViscosity{0, 0}),
                                            method_.amplification);
  }

  double initial_stable_step(const BodyParticles<D>& particles) const
  {
    double bound = std::numeric_limits<double>::infinity();
    std::vector<Eigen::AlignedBox<double, D>> velocities;
    for (const SceneBody& body : scene_.bodies) {
      const auto own = particles.velocities(static_cast<int>(velocities.size()));
      const Vector<D> v = own.min().cwiseAbs().cwiseMax(own.max().cwiseAbs());
      bound = std::min(bound, initial_stable_step(body, v));
      velocities.push_back(own);
      if (method_.time_step_rule == StepRule::published) continue;
      for (std::size_t other = 0; other + 1 < velocities.size(); ++other) {
        const auto& theirs = velocities[other];
        const double approach = (own.max() - theirs.min()).cwiseMax(theirs.max() - own.min()).norm();
        bound = std::min(bound, components::contact_time_step(method_.cell_size, approach));
      }
    }
    return bound;
  }

  /// Runs the step; an error of one rank becomes the same error on all.
  void run_step(const runtime::Step& step)
  {
    std::exception_ptr own;
    try {
      executor_->run(engine_->schedule(step_graph), step);
      return;
    } catch (const runtime::TaskError& error) {
      // What is not of the simulation keeps the name of its task.
      own = is_of_simulation(error.cause) ? error.cause : std::current_exception();
      if (communicator_.size() == 1) std::rethrow_exception(own);
    } catch (const runtime::OtherRankFailed&) {
    }
    throw_common_failure(own, n_steps_, after_failure_);
  }

  /// Looks at what the patches have cost since the last look, and deals them anew if that pays.
  void balance_if_due()
  {
    if (balance_interval_ == 0 || communicator_.size() == 1 || n_steps_ == 0 || n_steps_ % balance_interval_ != 0)
      return;
    const auto watch = executor_->watch("redistributing patches");
    const std::vector<double> own = profiler_->take_patch_costs();
    std::vector<double> costs(own.size(), 0.0);
    for (const auto& bytes : communicator_.gather(std::as_bytes(std::span(own)))) {
      const auto* cost = reinterpret_cast<const double*>(bytes.data());
      for (std::size_t p = 0; p < costs.size(); ++p) costs[p] += cost[p];
    }
    const runtime::PatchLayout& layout = engine_->layout();
    if (!rebalances_.empty() && rebalances_.back().imbalance_got == 0) {
      rebalances_.back().imbalance_got = runtime::imbalance(costs, layout.ranks(), communicator_.size());
    }
    constexpr double least_gain = 1.1;
    const auto deal = runtime::better_deal(layout, costs, least_gain);
    if (!deal) return;
    rebalances_.push_back({n_steps_, deal->imbalance_before, deal->imbalance_expected, 0});
    redistribute(deal->ranks);
  }

  void redistribute(const std::vector<int>& ranks)
  {
    runtime::PatchLayout layout = engine_->layout();
    layout.give_to_ranks(ranks, communicator_.size());
    auto engine = make_engine(layout);
    runtime::move_patches(engine_->warehouse(), engine->warehouse(), communicator_);
    engine->schedule(step_graph).recording = engine_->schedule(step_graph).recording;
    profiler_->follow(engine->schedule(step_graph), engine->bound(step_graph));
    engine_ = std::move(engine);
  }

  Method<D> method_;
  /// Ranks that failed at different places meet here, where no other messages are.
  runtime::Communicator after_failure_ = communicator_.duplicate();
  std::optional<runtime::Profiler> profiler_;
  std::size_t forecast_bytes_ = 0;
};

}  // namespace

MeanForces Simulation::take_mean_forces()
{
  const ContactImpulses contact = warehouse().take(contact_impulses);
  const LoadTotals loads = warehouse().take(load_totals);
  const double span = time_ - std::exchange(warehouse().global_state(forces_taken_at), time_);
  MeanForces mean{std::vector<ContactForce>(scene_.materials.size()),
                  std::vector<Eigen::Vector3d>(scene_.materials.size(), Eigen::Vector3d::Zero())};
  for (std::size_t m = 0; m < scene_.materials.size() && span > 0; ++m) {
    mean.contact[m] = {contact.by_material[m].linear / span, contact.by_material[m].angular / span};
    mean.loads[m] = Eigen::Vector3d(loads.impulse[m].data()) / span;
  }
  return mean;
}

std::unique_ptr<Simulation> Simulation::make(Scene scene, int n_threads)
{
  return make(std::move(scene), std::make_shared<runtime::Executor>(n_threads));
}

std::unique_ptr<Simulation> Simulation::make(Scene scene, std::shared_ptr<runtime::Executor> executor,
                                             const runtime::Communicator& communicator)
{
  if (scene.grid.dimension == 2) {
    return std::make_unique<SimulationOf<2>>(std::move(scene), std::move(executor), communicator);
  }
  return std::make_unique<SimulationOf<3>>(std::move(scene), std::move(executor), communicator);
}

}  // namespace tamp::tasks
