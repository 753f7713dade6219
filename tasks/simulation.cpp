#include "tasks/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/loads/time_step.hpp"
#include "components/materials/wave_speed.hpp"
#include "tasks/field_columns.hpp"
#include "tasks/fill_bodies.hpp"
#include "tasks/labels.hpp"
#include "tasks/simulation_error.hpp"
#include "tasks/state_digest.hpp"
#include "tasks/time_step.hpp"

namespace tamp::tasks
{

namespace
{

/// Steps at the start of a run that the trace keeps instance by instance.
constexpr long n_traced_steps = 20;

std::vector<std::string> material_names(const Scene& scene)
{
  std::vector<std::string> names;
  for (const SceneMaterial& m : scene.materials) names.push_back(m.name);
  return names;
}

double initial_wave_speed(const SceneMaterial& material)
{
  if (const auto* steel = std::get_if<components::Hypoelastic>(&material.model)) {
    return components::wave_speed(steel->bulk_modulus, steel->shear_modulus, material.density);
  }
  const auto& sand = std::get<components::TabularCap>(material.model);
  return components::wave_speed(sand.initial_bulk_modulus(), sand.initial_shear_modulus(), material.density);
}

template <class Interpolator>
class SimulationOf : public Simulation
{
  static constexpr int D = Interpolator::dimension;

 public:
  SimulationOf(Scene given, std::shared_ptr<runtime::Executor> executor)
      : Simulation(std::move(given), std::move(executor)),
        method_(scene_),
        layout_(scene_.grid, scene_.n_patches),
        step_graph_(time_step(method_), layout_, material_names(scene_), host_data<Interpolator>()),
        report_graph_(report_tasks(method_), layout_, material_names(scene_),
                      {host_data<Interpolator>().state, {&particle_report}}),
        warehouse_(std::array<const runtime::TaskGraph*, 2>{&step_graph_, &report_graph_}),
        step_(step_graph_, warehouse_),
        report_(report_graph_, warehouse_),
        step_schedule_(step_, n_threads()),
        report_schedule_(report_, n_threads()),
        profiler_(step_schedule_, step_, n_threads(), n_traced_steps)
  {
    fill_bodies<D>(scene_, warehouse_);
    forecast_bytes_ = warehouse_.forecast_bytes();
    totals_.stable_step = initial_stable_step();
  }

  void advance(double end) override
  {
    const double size = next_step_size(end);
    try {
      executor_->run(step_schedule_, {n_steps_, time_, size, last_step_size_});
    } catch (const runtime::TaskError& error) {
      std::rethrow_exception(error.cause);
    }
    check_failed_updates();
    warehouse_.advance();
    if (step_schedule_.recording) profiler_.add_step();
    take_totals();
    take_lost();
    ++n_steps_;
    time_ = time_ + size >= end * (1 - 1e-14) ? end : time_ + size;
    last_step_size_ = size;
  }

  ParticleReport report() override
  {
    executor_->run(report_schedule_, {n_steps_, time_, 0, 0});
    return warehouse_.result(particle_report);
  }

  const LostParticles& lost() const override { return lost_; }
  const runtime::TaskGraph& graph() const override { return step_graph_; }
  const runtime::MemoryLedger& ledger() const override { return warehouse_.ledger(); }
  std::size_t forecast_bytes() const override { return forecast_bytes_; }
  runtime::Profile profile() const override { return profiler_.profile(); }
  void record(bool on) override { step_schedule_.recording = on; }
  std::size_t n_particles(int material) const override { return warehouse_.n_particles(material); }
  std::vector<runtime::ParticleBlock> particle_columns() override { return columns_.particles(method_, warehouse_); }
  runtime::NodeBlock node_columns() override { return columns_.nodes(method_, warehouse_); }
  std::string digest() override { return state_digest(warehouse_); }

  std::size_t least_bytes_per_particle(int material) const override
  {
    std::size_t bytes = 0;
    for (const runtime::Field* field : warehouse_.particle_fields(0, material)) {
      if (field->state && used_in_step(*field->label)) bytes += field->label->value_bytes() * (field->carried ? 1 : 2);
    }
    return bytes;
  }

 private:
  bool used_in_step(const runtime::Label& label) const
  {
    for (const runtime::TaskDeclaration& task : step_graph_.declarations()) {
      for (const runtime::Access& access : task.accesses) {
        if (access.label == &label) return true;
      }
    }
    return false;
  }

  double next_step_size(double end) const
  {
    const double size = std::min(scene_.time.multiplier * totals_.stable_step, scene_.time.maximum_step);
    if (!(size >= scene_.time.minimum_step)) {
      throw SimulationError(
          fmt::format("the time step {:.3g} s is below the minimum of {:.3g} s", size, scene_.time.minimum_step), "",
          -1, {});
    }
    return std::min(size, end - time_);
  }

  double initial_stable_step() const
  {
    double bound = std::numeric_limits<double>::infinity();
    const auto viscosity = method_.viscosity.value_or(components::ArtificialViscosity{0, 0});
    for (const SceneBody& body : scene_.bodies) {
      const double c = initial_wave_speed(scene_.materials[static_cast<std::size_t>(body.material)]);
      const Vector<D> v = vector_of<D>(body.velocity);
      bound = std::min(
          bound, method_.time_step_rule == StepRule::published
                     ? components::published_time_step<D>(method_.cell_size, c, v)
                     : method_.step_factor * components::viscous_time_step<D>(method_.cell_size, c, v, 0, viscosity));
    }
    return bound;
  }

  void check_failed_updates()
  {
    const StepTotals& step = warehouse_.result(step_totals);
    const std::size_t failures = totals_.updates.failures + step.updates.failures;
    if (failures <= static_cast<std::size_t>(scene_.failed_updates_allowed)) return;
    const FailedUpdate& failed = step.failed;
    throw SimulationError(fmt::format("{}; {} stress updates have failed, {} are allowed", failed.reason(), failures,
                                      scene_.failed_updates_allowed),
                          scene_.materials[static_cast<std::size_t>(failed.material)].name, failed.particle,
                          {failed.position.begin(), failed.position.begin() + D});
  }

  void take_totals()
  {
    const StepTotals& step = warehouse_.result(step_totals);
    totals_.stable_step = std::numeric_limits<double>::infinity();
    totals_.combine(step);
    impulse_.combine(warehouse_.result(grid_impulse));
  }

  void take_lost()
  {
    runtime::Migration& migration = *step_.migration();
    bool any = false;
    for (int g = 0; g < warehouse_.n_groups(); ++g) {
      if (migration.n_lost(g) == 0) continue;
      any = true;
      const std::vector<double> mass = migration.lost(particle::mass, g);
      const auto velocity = migration.lost(particle::velocity<D>, g);
      lost_.count += mass.size();
      for (std::size_t p = 0; p < mass.size(); ++p) {
        lost_.mass += mass[p];
        lost_.momentum.template head<D>() += mass[p] * velocity[p];
      }
    }
    if (any) migration.clear_lost();
  }

  Method<Interpolator> method_;
  runtime::PatchLayout layout_;
  runtime::TaskGraph step_graph_;
  runtime::TaskGraph report_graph_;
  runtime::Warehouse warehouse_;
  runtime::BoundGraph step_;
  runtime::BoundGraph report_;
  runtime::Schedule step_schedule_;
  runtime::Schedule report_schedule_;
  runtime::Profiler profiler_;
  FieldColumns<Interpolator> columns_;
  std::size_t forecast_bytes_ = 0;
  LostParticles lost_;
};

}  // namespace

std::unique_ptr<Simulation> Simulation::make(Scene scene, int n_threads)
{
  return make(std::move(scene), std::make_shared<runtime::Executor>(n_threads));
}

std::unique_ptr<Simulation> Simulation::make(Scene scene, std::shared_ptr<runtime::Executor> executor)
{
  if (scene.grid.dimension == 2)
    return std::make_unique<SimulationOf<components::Gimp<2>>>(std::move(scene), std::move(executor));
  return std::make_unique<SimulationOf<components::Gimp<3>>>(std::move(scene), std::move(executor));
}

}  // namespace tamp::tasks
