#include "tools/run/run_history.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "components/portable_math.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "tasks/set_up/initial_moduli.hpp"
#include "tools/scene/tables/csv_table.hpp"

namespace tamp::tools
{

namespace
{

constexpr std::array<char, 3> axis_names{'x', 'y', 'z'};

Eigen::Vector3d velocity_of(const tasks::SceneBody& body)
{
  return Eigen::Vector3d(body.velocity.data());
}

std::vector<std::size_t> moving_bodies(const tasks::Scene& scene)
{
  std::vector<std::size_t> moving;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const tasks::SceneBody& body = scene.bodies[b];
    const bool turns = Eigen::Vector3d(body.angular_velocity.data()).norm() > 0;
    if (velocity_of(body).norm() > 0 || turns || body.rigid || body.pressure || body.functions.velocity)
      moving.push_back(b);
  }
  return moving;
}

/// Calls `visit(k, extreme, column)` for every extreme over a material's states that a row shows.
template <class Visit>
void for_each_extreme(const tasks::SceneMaterial& material, const Visit& visit)
{
  std::visit(
      [&]<class Model>(const Model&) {
        std::size_t k = 0;
        for (const components::StateExtreme& extreme : components::state_extremes<Model>()) {
          visit(k++, extreme, components::state_columns<Model>()[extreme.column]);
        }
      },
      material.model);
}

/// The greatest acceleration by gravity and centrifuge of matter at rest, anywhere in the grid [m/s^2].
double greatest_acceleration(const tasks::Scene& scene)
{
  const double gravity = Eigen::Vector3d(scene.gravity.data()).norm();
  if (!scene.centrifuge) return gravity;
  double greatest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) {
      const int n = (corner >> k & 1) == 0 ? 0 : scene.grid.n_cells[static_cast<std::size_t>(k)];
      x[k] = scene.grid.coordinate(k, n);
    }
    greatest = std::max(greatest, scene.centrifuge->acceleration(x, Eigen::Vector3d::Zero(), 0).norm());
  }
  return gravity + greatest;
}

double fastest_wave_speed(const tasks::Scene& scene)
{
  double fastest = 0;
  for (const tasks::SceneMaterial& m : scene.materials) fastest = std::max(fastest, tasks::initial_wave_speed(m));
  return fastest;
}

/// In which waves of the slowest deformable material cross the cells over which a grid spreads a blow; 0 without waves.
double time_over_cells(const tasks::Scene& scene)
{
  constexpr double n_cells = 4;
  double slowest = std::numeric_limits<double>::infinity();
  for (const tasks::SceneBody& body : scene.bodies) {
    if (body.rigid) continue;
    slowest = std::min(slowest, tasks::initial_wave_speed(scene.materials[static_cast<std::size_t>(body.material)]));
  }
  return slowest > 0 ? n_cells * scene.grid.cell_size / slowest : 0;
}

double mass_of(const tasks::ParticleReport& report)
{
  double mass = 0;
  for (const tasks::BodySums& body : report.bodies) mass += body.mass;
  return mass;
}

/// Where nothing has been measured there is no extreme; and 0 has no sign.
double extreme_or_nothing(double value)
{
  return std::isfinite(value) ? value + 0.0 : 0;
}

}  // namespace

RunHistory::RunHistory(tasks::Simulation& simulation)
    : simulation_(simulation),
      tracked_(moving_bodies(simulation.scene())),
      initial_(simulation.report()),
      mass_(mass_of(initial_)),
      wave_speed_(fastest_wave_speed(simulation.scene())),
      acceleration_(greatest_acceleration(simulation.scene())),
      time_over_cells_(time_over_cells(simulation.scene())),
      elastic_at_start_(simulation.energies().elastic),
      report_(initial_)
{
  largest_.momenta = initial_.sum_of_momenta;
  add_columns();
}

void RunHistory::begin(const std::filesystem::path& folder)
{
  runtime::on_first_rank(simulation_.communicator(), [&] { csv_.emplace(folder / "history.csv", column_names()); });
}

std::string RunHistory::resume(const std::filesystem::path& folder, long kept_until, const runtime::CsvExtent& expected)
{
  runtime::on_first_rank(simulation_.communicator(), [&] {
    csv_ = runtime::CsvWriter::continued(folder / "history.csv", column_names(), kept_until, expected);
    take_extremes(folder / "history.csv");
  });
  return csv_ ? csv_->notice() : "";
}

void RunHistory::take_extremes(const std::filesystem::path& file)
{
  const auto columns = numbers_by_column(file);
  constexpr std::size_t time = 1;
  for (const auto& [name, values] : columns) {
    for (std::size_t i = 0; i < values.size(); ++i) extremes_[name].take(values[i], columns[time].second[i]);
  }
}

template <class Value>
void RunHistory::add_vector(const std::string& name, const std::string& unit, const Value& value)
{
  for (int k = 0; k < simulation_.scene().grid.dimension; ++k) {
    columns_.push_back({fmt::format("{}_{}[{}]", name, axis_names[static_cast<std::size_t>(k)], unit),
                        [value, k] { return Eigen::Vector3d(value())[k]; }});
  }
}

void RunHistory::add_columns()
{
  const tasks::Scene& scene = simulation_.scene();
  columns_ = {{"step", [this] { return static_cast<double>(simulation_.n_steps()); }},
              {"time[s]", [this] { return simulation_.time(); }},
              {"dt[s]", [this] { return simulation_.last_step_size(); }},
              {"kinetic[J]", [this] { return energies_.kinetic; }},
              {"elastic[J]", [this] { return energies_.elastic; }},
              {"plastic[J]", [this] { return energies_.plastic; }},
              {"viscous[J]", [this] { return energies_.viscous; }},
              {"contact[J]", [this] { return energies_.contact; }},
              {"filter[J]", [this] { return energies_.filter; }},
              {"half_step[J]", [this] { return energies_.half_step; }},
              {"external[J]", [this] { return energies_.external; }},
              {"total[J]", [this] { return energies_.total; }}};
  add_vector("momentum", "N s", [this] { return report_.momentum(); });
  for (const std::size_t b : tracked_) add_body_columns(b);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].functions.exact_displacement) add_error_columns(b);
  }
  for (std::size_t m = 0; m < scene.materials.size(); ++m) add_peak_columns(m, "", report_.materials);
  for (std::size_t m = 0; scene.has_nose() && m < scene.materials.size(); ++m) {
    add_peak_columns(m, ".near_nose", nose_report_.materials);
  }
  columns_.push_back({"lost[particles]", [this] { return static_cast<double>(lost_.count); }});
  columns_.push_back({"lost_mass[kg]", [this] { return lost_.mass; }});
  columns_.push_back({"lost_kinetic[J]", [this] { return lost_.kinetic; }});
  add_vector("lost_momentum", "N s", [this] { return lost_.momentum; });
}

void RunHistory::add_body_columns(std::size_t body)
{
  const tasks::SceneBody& given = simulation_.scene().bodies[body];
  const int dimension = simulation_.scene().grid.dimension;
  const auto sums = [this, body]() -> const tasks::BodySums& { return report_.bodies[body]; };
  const auto contact = [this, &given]() -> const tasks::ContactForce& {
    return mean_forces_.contact[static_cast<std::size_t>(given.material)];
  };
  const auto first = static_cast<std::ptrdiff_t>(columns_.size());
  columns_.push_back({given.name + ".depth[m]", [this, body] { return depth(body); }});
  add_vector(given.name + ".velocity", "m/s", [sums]() -> Eigen::Vector3d { return sums().momentum / sums().mass; });
  columns_.push_back(
      {given.name + ".tilt[deg]", [sums, dimension] { return sums().tilt(dimension) * 180 / std::numbers::pi; }});
  if (dimension == 3) add_vector(given.name + ".spin", "rad/s", [sums] { return sums().spin(); });
  add_vector(given.name + ".contact_force", "N", [contact] { return contact().force; });
  if (given.drive && dimension == 3) {
    add_vector(given.name + ".contact_torque", "N m", [contact] { return contact().torque; });
  } else if (given.drive) {
    columns_.push_back({given.name + ".contact_torque[N m]", [contact] { return contact().torque.z(); }});
  }
  if (given.pressure) {
    add_vector(given.name + ".load", "N",
               [this, &given] { return mean_forces_.loads[static_cast<std::size_t>(given.material)]; });
  }
  if (given.axis) {
    const Eigen::Vector3d nose(given.axis->nose.data()), tail(given.axis->tail.data());
    add_vector(given.name + ".nose", "m", [sums, nose] { return sums().position_of(nose); });
    add_vector(given.name + ".tail", "m", [sums, tail] { return sums().position_of(tail); });
    columns_.push_back({given.name + ".axis_angle[deg]", [this, body] { return axis_angle(body); }});
  }
  // Nothing is known of a body that has left; the sign of what is not a number would be chance.
  std::for_each(columns_.begin() + first, columns_.end(), [sums](Column& column) {
    column.value = [sums, value = column.value] {
      return sums().mass == 0 ? std::numeric_limits<double>::quiet_NaN() : value();
    };
  });
}

void RunHistory::add_error_columns(std::size_t body)
{
  const std::string name = simulation_.scene().bodies[body].name + ".displacement_error";
  const tasks::DisplacementError& error = report_.displacement_errors[body];
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  columns_.push_back({name + "[m]", [=, &error] { return error.mass > 0 ? error.rms() : unknown; }});
  columns_.push_back({name + "_max[m]", [=, &error] { return error.mass > 0 ? error.greatest : unknown; }});
}

void RunHistory::add_peak_columns(std::size_t material, const std::string& where, const tasks::PeaksOfMaterials& peaks)
{
  const tasks::SceneMaterial& given = simulation_.scene().materials[material];
  const std::string name = given.name + where;
  const tasks::MaterialPeaks& of_material = peaks[material];
  columns_.push_back({name + ".p_max[Pa]", [&of_material] { return extreme_or_nothing(of_material.pressure); }});
  columns_.push_back({name + ".q_max[Pa]", [&of_material] { return of_material.q; }});
  for_each_extreme(given, [&](std::size_t k, const components::StateExtreme& extreme, const auto& column) {
    columns_.push_back({fmt::format("{}.{}_{}[{}]", name, column.name, extreme.greatest ? "max" : "min", column.unit),
                        [&of_material, &extreme, k] { return extreme_or_nothing(of_material.extreme(k, extreme)); }});
  });
}

std::vector<std::string> RunHistory::column_names() const
{
  std::vector<std::string> names;
  for (const Column& column : columns_) names.push_back(column.name);
  return names;
}

void RunHistory::measure()
{
  report_ = simulation_.report();
  nose_report_ = simulation_.nose_peaks();
  lost_ = simulation_.lost();
  const tasks::EnergyLedger& since_start = simulation_.energies();
  EnergyBalance& e = energies_;
  e = {report_.kinetic,
       since_start.elastic,
       since_start.plastic,
       since_start.viscous,
       since_start.contact,
       since_start.filter,
       since_start.half_step - since_start.gravity_at_end,
       since_start.external(),
       0};
  e.total =
      e.kinetic + lost_.kinetic + e.elastic + e.plastic + e.viscous + e.contact + e.filter - e.half_step - e.external;

  largest_.momenta = std::max(largest_.momenta, report_.sum_of_momenta + weight_of_a_step());
  const Eigen::Vector3d given(simulation_.grid_totals().impulse.data());
  const Eigen::Vector3d change = report_.momentum() + lost_.momentum - initial_.momentum();
  momentum_error_ = largest_.momenta > 0 ? (change - given).norm() / largest_.momenta : 0;
}

std::string RunHistory::energy_problem(double limit)
{
  const tasks::EnergyLedger& since_start = simulation_.energies();
  largest_.given_from_outside = std::max(largest_.given_from_outside, std::abs(since_start.external()));
  if (!std::isfinite(limit) || !knows_energy()) return "";
  const double error = wrong_energy();
  if (error <= limit * energy_scale() || error <= negligible_energy()) return "";
  return fmt::format(
      "the energy is wrong by {:.3g} J, {:.3g} times the {:.3g} J that it is judged by, more than "
      "/limits/energy_error, {:.3g}",
      error, energy_error(), energy_scale(), limit);
}

bool RunHistory::knows_energy() const
{
  const auto& frame = simulation_.scene().centrifuge;
  return !frame || !frame->is_unsteady();
}

double RunHistory::known_energy_error() const
{
  return knows_energy() && wrong_energy() > negligible_energy() ? energy_error() : 0;
}

double RunHistory::energy_error() const
{
  return energy_scale() > 0 ? wrong_energy() / energy_scale() : 0;
}

double RunHistory::energy_scale() const
{
  const double time = simulation_.time();
  const double soon = time > 0 ? largest_.given_from_outside * time_over_cells_ / time : 0;
  return given_energy() + soon;
}

double RunHistory::wrong_energy() const
{
  const tasks::EnergyLedger& since_start = simulation_.energies();
  return std::max(std::abs(since_start.sum() - elastic_at_start_), -since_start.filter);
}

double RunHistory::given_energy() const
{
  return initial_.kinetic + elastic_at_start_ + largest_.given_from_outside;
}

double RunHistory::negligible_energy() const
{
  constexpr double part_of_wave_speed = 1e-6;
  const double slow = part_of_wave_speed * wave_speed_;
  // Velocities are those of half a step before.
  const double late = acceleration_ * simulation_.last_step_size();
  const double in_motion = std::max(0.0, initial_.kinetic + simulation_.energies().gained);
  return 0.5 * mass_ * slow * slow + late * std::sqrt(2 * mass_ * in_motion) +
         std::abs(simulation_.energies().last_driving);
}

double RunHistory::damped_energy() const
{
  const double depends_on_the_way = energies_.kinetic + energies_.plastic + energies_.contact;
  return std::max(0.0, std::min(simulation_.grid_totals().taken_by_damping, depends_on_the_way));
}

BalanceShares RunHistory::balances() const
{
  const auto part_of_given = [&](double energy) { return given_energy() > 0 ? energy / given_energy() : 0; };
  const double mass = lost_.mass + mass_of(report_);
  return {known_energy_error(), momentum_error_, part_of_given(std::max(0.0, simulation_.energies().filter)),
          part_of_given(damped_energy()), mass > 0 ? lost_.mass / mass : 0};
}

void RunHistory::look_at_balances()
{
  const BalanceShares now = balances();
  const tasks::SceneLimits& limits = simulation_.scene().limits;
  const auto look = [&](double share, double limit, tasks::Occurrences& above) {
    if (share > limit) above.add(simulation_.n_steps(), simulation_.time());
  };
  look(now.energy_drift, limits.energy_drift, balances_above_.energy_drift);
  look(now.momentum_error, limits.momentum_error, balances_above_.momentum_error);
  look(now.filtered_energy, limits.filtered_energy, balances_above_.filtered_energy);
  look(now.damped_energy, limits.damped_energy, balances_above_.damped_energy);
  look(now.lost_mass, limits.lost_mass, balances_above_.lost_mass);
}

double RunHistory::weight_of_a_step() const
{
  return mass_ * acceleration_ * simulation_.last_step_size();
}

double RunHistory::depth(std::size_t body) const
{
  const tasks::BodySums& sums = report_.bodies[body];
  const Eigen::Vector3d moved = (sums.position - sums.reference_position) / sums.mass;
  const Eigen::Vector3d velocity = velocity_of(simulation_.scene().bodies[body]);
  return velocity.norm() > 0 ? moved.dot(velocity.normalized()) : moved.norm();
}

const Eigen::Vector3d& RunHistory::contact_force(std::size_t body) const
{
  return mean_forces_.contact[static_cast<std::size_t>(simulation_.scene().bodies[body].material)].force;
}

double RunHistory::axis_angle(std::size_t body) const
{
  const tasks::BodyAxis& axis = *simulation_.scene().bodies[body].axis;
  const tasks::BodySums& sums = report_.bodies[body];
  const Eigen::Vector3d along =
      sums.rotation() * (Eigen::Vector3d(axis.nose.data()) - Eigen::Vector3d(axis.tail.data()));
  return portable::asin(-along[simulation_.scene().grid.dimension - 1] / along.norm()) * 180 / std::numbers::pi;
}

void RunHistory::write_row()
{
  measure();
  look_at_balances();
  mean_forces_ = simulation_.take_mean_forces();
  std::vector<double> row;
  for (const Column& column : columns_) {
    row.push_back(column.value());
    extremes_[column.name].take(row.back(), simulation_.time());
  }
  runtime::on_first_rank(simulation_.communicator(), [&] { csv_->write_row(row); });
}

}  // namespace tamp::tools
