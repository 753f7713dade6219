#include "tasks/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "runtime/warehouse/storage_forecast.hpp"
#include "tasks/graphs.hpp"
#include "tasks/report/field_columns.hpp"
#include "tasks/report/state_digest.hpp"
#include "tasks/set_up/fill_bodies.hpp"
#include "tasks/set_up/initial_step.hpp"
#include "tasks/simulation_error.hpp"
#include "tasks/step_graph.hpp"
#include "tasks/step_refusal.hpp"

namespace tamp::tasks
{

namespace
{

bool uses(const runtime::TaskGraph& graph, const runtime::Label& label)
{
  const auto names_it = [&](const runtime::Access& access) { return access.label == &label; };
  return std::any_of(graph.declarations().begin(), graph.declarations().end(), [&](const auto& task) {
    return std::any_of(task.accesses.begin(), task.accesses.end(), names_it);
  });
}

std::vector<runtime::GraphTasks> changed_by(const ChangeStep& change, std::vector<runtime::GraphTasks> graphs)
{
  if (change) change(graphs[step_graph].tasks);
  return graphs;
}

template <int D>
class SimulationOf : public Simulation
{
 public:
  SimulationOf(Scene given, std::shared_ptr<runtime::Executor> executor, const runtime::Communicator& communicator,
               const ChangeStep& change)
      : Simulation(std::move(given), std::move(executor)), method_(scene_)
  {
    const BodyParticles<D> particles(scene_, runtime::PatchLayout(scene_.grid, scene_.n_patches));
    const std::vector<std::size_t> n_particles = particles.counts();
    engine_ = std::make_unique<runtime::Engine>(dealt(scene_, n_particles, communicator.size()), material_names(scene_),
                                                changed_by(change, graphs_of(method_)), *executor_, communicator);
    particles.store(warehouse());
    make_rigid_bodies(particles);
    warehouse().global_state(refused_steps) = {};
    warehouse().global_state(monitor_records) = {};
    warehouse().global_state(tasks::step_records) = {};
    warehouse().global_state(longest_step) = {initial_stable_step(method_, particles), {}};
    warehouse().global_state(energy_ledger).elastic = particles.stored_energy();
    forecast_bytes_ =
        static_cast<std::size_t>(runtime::forecast_bytes(engine_->graphs(), n_particles, communicator.size()));
  }

  runtime::FieldCopy fields(const FieldChoice& choice, bool with_nodes) override
  {
    runtime::FieldCopy copy = copy_of_fields(method_, choice, with_nodes, warehouse(), *executor_, communicator());
    copy.held = runtime::LedgerHold(warehouse().ledger().copies, copy.n_bytes());
    return copy;
  }

 private:
  void make_rigid_bodies(const BodyParticles<D>& particles)
  {
    RigidStates& states = warehouse().global_state(rigid_states);
    for (RigidBody& body : method_.rigid_bodies) {
      const SceneBody& given = scene_.bodies[static_cast<std::size_t>(body.body)];
      body.properties = within_whole(body, scene_, particles.mass_properties(body.body));
      states.of(body) =
          at_rest_across_mirrors(body, initial_state(body.properties, in_space<D>(vector_of<D>(given.velocity)),
                                                     Eigen::Vector3d(given.angular_velocity.data())));
    }
  }

  Method<D> method_;
};

}  // namespace

std::unique_ptr<Simulation> Simulation::make(Scene scene, int n_threads)
{
  return make(std::move(scene), std::make_shared<runtime::Executor>(n_threads));
}

std::unique_ptr<Simulation> Simulation::make(Scene scene, std::shared_ptr<runtime::Executor> executor,
                                             const runtime::Communicator& communicator, const ChangeStep& change)
{
  if (scene.grid.dimension == 2) {
    return std::make_unique<SimulationOf<2>>(std::move(scene), std::move(executor), communicator, change);
  }
  return std::make_unique<SimulationOf<3>>(std::move(scene), std::move(executor), communicator, change);
}

double Simulation::next_step_size() const
{
  const double size = std::min(scene_.time.multiplier * stable_step(), scene_.time.maximum_step);
  if (size >= scene_.time.minimum_step) return size;
  throw SimulationError(
      fmt::format("the time step {:.3g} s is below the minimum of {:.3g} s", size, scene_.time.minimum_step), "", -1,
      {});
}

/// Length of another try after a step that was refused; throws its reason if there is none.
double Simulation::shorter_step(double refused_size, int n_tries) const
{
  const double size = scene_.time.redo_factor * refused_size;
  if (n_tries <= scene_.time.redos && size >= scene_.time.minimum_step) return size;
  throw SimulationError(
      *refusal(scene_, warehouse().total(step_totals), warehouse().result(step_totals), refused_size));
}

/// Counts a refused try, the only change to the state before the step.
void Simulation::note_refusal()
{
  const StepTotals& step = warehouse().result(step_totals);
  const bool moved_badly = step.bad_motion.particle >= 0;
  const ParticlePlace place = moved_badly ? ParticlePlace(step.bad_motion) : ParticlePlace(step.failed);
  warehouse().global_state(refused_steps).add(n_steps(), time(), place);
}

/// Records the last step, and the bound that it had to keep within.
void Simulation::note_step(const StepBound& bound, bool is_redone)
{
  const StepCause cause = cause_of(last_step_size(), scene_.time, bound, n_steps() == 1, is_redone);
  warehouse().global_state(tasks::step_records).add(cause, {n_steps(), time(), last_step_size(), bound.setter});
}

void Simulation::sample_state()
{
  if (!scene_.has_deformable()) return;
  engine_->run(sample_graph);
  const StateSample& sample = warehouse().result(state_sample);
  const SceneLimits& limits = scene_.limits;
  MonitorRecords& records = warehouse().global_state(monitor_records);
  Share unseen = warehouse().result(null_space_motion);
  unseen.whole += std::max(0.0, energies().elastic);
  records.null_space.add(unseen, limits.null_space, n_steps(), time());
  records.uneven_pressure.add(sample.uneven_pressure, limits.uneven_pressure, n_steps(), time());
  records.torn_apart.add(sample.torn_apart, limits.torn_apart, n_steps(), time(), sample.torn);
  const SwollenSample& swollen = warehouse().result(swollen_sample);
  records.greatest_load = std::max(records.greatest_load, sample.load.pressure());
  records.swollen_load.add(swollen.bearing, limits.swollen_load, n_steps(), time(), swollen.first);
  if (scene_.has_image_walls()) {
    const WallSample& at_walls = warehouse().result(wall_sample);
    records.early_at_walls.add(at_walls.early, limits.early_at_walls, n_steps(), time(), at_walls.first);
  }
  records.looser_than_tested.add(sample.borne_by_looser, limits.looser_than_tested, n_steps(), time(), sample.looser);
  if (missed_substeps(updates(), scene_.n_particles()) > limits.missed_substeps) {
    records.missed_substeps.add(n_steps(), time());
  }
  if (out_of_range(updates()) > limits.out_of_range) {
    records.out_of_range.add(n_steps(), time(), sample.out_of_range);
  }
}

void Simulation::sample_contact(double step_size)
{
  if (engine_->graph(contact_graph).declarations().empty()) return;
  engine_->run(contact_graph, step_size);
  const ContactSample& sample = warehouse().result(contact_sample);
  const SceneLimits& limits = scene_.limits;
  MonitorRecords& records = warehouse().global_state(monitor_records);
  records.early_contact.add(sample.early, limits.early_contact, n_steps(), time(), sample.first_early);
  records.interpenetration.add(sample.within, limits.interpenetration, n_steps(), time(), sample.first_within);
}

void Simulation::advance(double end)
{
  try {
    const StepBound bound = warehouse().global_state(longest_step);
    double size = std::min(next_step_size(), end - time());
    if (scene_.limits.samples_after(n_steps() + 1)) sample_contact(size);
    int n_tries = 1;
    for (; !engine_->advance(size, end); ++n_tries) {
      note_refusal();
      size = shorter_step(size, n_tries);
    }
    note_step(bound, n_tries > 1);
    if (scene_.limits.samples_after(n_steps())) sample_state();
  } catch (const SimulationError&) {
    throw;
  } catch (const runtime::StepError& of_other_rank) {
    throw SimulationError(of_other_rank.what(), "", -1, {});
  }
}

ParticleReport Simulation::report()
{
  engine_->run(report_graph);
  return warehouse().result(particle_report);
}

NoseReport Simulation::nose_peaks() const
{
  return scene_.has_nose() ? warehouse().result(nose_report) : NoseReport{};
}

MeanForces Simulation::take_mean_forces()
{
  const ContactImpulses contact = warehouse().take(contact_impulses);
  const LoadTotals loads = warehouse().take(load_totals);
  // Means are over kicks, the last of which ends in the middle of the last step.
  const double until = time() - 0.5 * last_step_size();
  const double span = until - std::exchange(warehouse().global_state(forces_taken_at), until);
  MeanForces mean{std::vector<ContactForce>(scene_.materials.size()),
                  std::vector<Eigen::Vector3d>(scene_.materials.size(), Eigen::Vector3d::Zero())};
  for (std::size_t m = 0; m < scene_.materials.size() && span > 0; ++m) {
    mean.contact[m] = {contact.by_material[m].linear / span, contact.by_material[m].angular / span};
    mean.loads[m] = Eigen::Vector3d(loads.impulse[m].data()) / span;
  }
  return mean;
}

std::size_t Simulation::n_particles(int material) const
{
  return communicator().sum(warehouse().n_particles(material));
}

std::string Simulation::digest()
{
  return state_digest(warehouse(), communicator());
}

std::size_t Simulation::least_bytes_per_particle(int material) const
{
  std::size_t bytes = 0;
  for (const runtime::Field* field : warehouse().particle_fields(0, material)) {
    if (!field->state || !uses(engine_->graph(step_graph), *field->label)) continue;
    bytes += field->label->value_bytes() * (field->carried ? 1 : 2);
  }
  return bytes;
}

ParticleBytes Simulation::particle_bytes(int material) const
{
  ParticleBytes bytes;
  for (const runtime::Field* field : warehouse().particle_fields(0, material)) {
    const std::size_t once = field->label->value_bytes(), kept = once * (field->state && !field->carried ? 2 : 1);
    if (field->state) bytes.state += once;
    if (field->state) bytes.kept_state += kept;
    bytes.all += kept;
  }
  return bytes;
}

}  // namespace tamp::tasks
