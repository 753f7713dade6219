#include "tools/run/run_history.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "components/portable_math.hpp"
#include "runtime/ranks/together.hpp"
#include "tasks/set_up/initial_moduli.hpp"

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
    if (velocity_of(body).norm() > 0 || turns || body.rigid) moving.push_back(b);
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

void add_peak_columns(const tasks::SceneMaterial& material, const std::string& where, std::vector<std::string>& names)
{
  const std::string name = material.name + where;
  names.insert(names.end(), {name + ".p_max[Pa]", name + ".q_max[Pa]"});
  for_each_extreme(material, [&](std::size_t, const components::StateExtreme& extreme, const auto& column) {
    names.push_back(fmt::format("{}.{}_{}[{}]", name, column.name, extreme.greatest ? "max" : "min", column.unit));
  });
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
      report_(initial_)
{
}

void RunHistory::begin(const std::filesystem::path& folder)
{
  runtime::by_first(simulation_.communicator(), [&] { csv_.emplace(folder / "history.csv", columns()); });
}

std::string RunHistory::go_on(const std::filesystem::path& folder, long kept_until, const runtime::CsvExtent& expected)
{
  runtime::by_first(simulation_.communicator(), [&] {
    csv_ = runtime::CsvWriter::continued(folder / "history.csv", columns(), kept_until, expected);
  });
  return csv_ ? csv_->notice() : "";
}

std::vector<std::string> RunHistory::columns() const
{
  const tasks::Scene& scene = simulation_.scene();
  const auto dimension = static_cast<std::size_t>(scene.grid.dimension);
  std::vector<std::string> names{"step",       "time[s]",    "dt[s]",      "kinetic[J]",  "elastic[J]",
                                 "plastic[J]", "viscous[J]", "contact[J]", "external[J]", "total[J]"};
  const auto add_vector = [&](const std::string& name, const std::string& unit) {
    for (std::size_t k = 0; k < dimension; ++k) names.push_back(fmt::format("{}_{}[{}]", name, axis_names[k], unit));
  };
  add_vector("momentum", "N s");
  for (const std::size_t b : tracked_) {
    const std::string& body = scene.bodies[b].name;
    names.push_back(body + ".depth[m]");
    add_vector(body + ".velocity", "m/s");
    names.push_back(body + ".tilt[deg]");
    if (dimension == 3) add_vector(body + ".spin", "rad/s");
    add_vector(body + ".contact_force", "N");
    if (scene.bodies[b].drive) {
      dimension == 3 ? add_vector(body + ".contact_torque", "N m") : names.push_back(body + ".contact_torque[N m]");
    }
    if (!scene.bodies[b].axis) continue;
    add_vector(body + ".nose", "m");
    add_vector(body + ".tail", "m");
    names.push_back(body + ".axis_angle[deg]");
  }
  for (const tasks::SceneMaterial& m : scene.materials) add_peak_columns(m, "", names);
  if (scene.has_nose()) {
    for (const tasks::SceneMaterial& m : scene.materials) add_peak_columns(m, ".near_nose", names);
  }
  names.insert(names.end(), {"lost[particles]", "lost_mass[kg]"});
  add_vector("lost_momentum", "N s");
  return names;
}

void RunHistory::measure()
{
  report_ = simulation_.report();
  near_noses_ = simulation_.near_noses();
  lost_ = simulation_.lost();
  const tasks::StepTotals& totals = simulation_.totals();
  EnergyBalance& e = energies_;
  e = {report_.kinetic,
       totals.elastic,
       totals.plastic,
       totals.viscous,
       totals.contact,
       report_.gravity_work - initial_.gravity_work + totals.driving,
       0};
  e.total = e.kinetic + e.elastic + e.plastic + e.viscous + e.contact - e.external;
  const double largest =
      std::max({e.kinetic, std::abs(e.elastic), e.plastic, e.viscous, e.contact, std::abs(e.external)});
  const double energy_scale = initial_.kinetic > 0 ? initial_.kinetic : largest;
  energy_error_ = energy_scale > 0 ? std::abs(e.total - initial_.kinetic) / energy_scale : 0;
  given_from_outside_ = std::max(given_from_outside_, std::abs(e.external));

  double momentum_scale = 0;
  for (std::size_t b = 0; b < simulation_.scene().bodies.size(); ++b) {
    momentum_scale += std::max(initial_.bodies[b].momentum.norm(), report_.bodies[b].momentum.norm());
  }
  const Eigen::Vector3d given(simulation_.grid_totals().impulse.data());
  const Eigen::Vector3d change = report_.momentum() + lost_.momentum - initial_.momentum();
  momentum_error_ = momentum_scale > 0 ? (change - given).norm() / momentum_scale : 0;
}

std::string RunHistory::energy_problem(double limit) const
{
  const auto& frame = simulation_.scene().centrifuge;
  const bool is_balanced = lost_.count == 0 && !(frame && frame->is_unsteady());
  if (!std::isfinite(limit) || !is_balanced) return "";
  const double given = initial_.kinetic + given_from_outside_;
  const double error = std::abs(energies_.total - initial_.kinetic);
  if (error <= limit * given || error <= negligible_energy()) return "";
  return fmt::format(
      "the energy is wrong by {:.3g} J, {:.3g} times the {:.3g} J that the run has been given, more than "
      "/limits/energy_error, {:.3g}",
      error, error / given, given, limit);
}

double RunHistory::negligible_energy() const
{
  const tasks::Scene& scene = simulation_.scene();
  double mass = 0;
  for (const tasks::BodySums& body : initial_.bodies) mass += body.mass;
  double fastest = 0;
  for (const tasks::SceneMaterial& m : scene.materials) fastest = std::max(fastest, tasks::initial_wave_speed(m));
  constexpr double part_of_wave_speed = 1e-6;
  const double slow = part_of_wave_speed * fastest;
  // Velocities are those of half a step before.
  const double late = greatest_acceleration(scene) * simulation_.last_step_size();
  return 0.5 * mass * slow * slow + late * std::sqrt(2 * mass * report_.kinetic);
}

double RunHistory::depth(std::size_t body) const
{
  const tasks::BodySums& sums = report_.bodies[body];
  const Eigen::Vector3d moved = (sums.position - sums.reference_position) / sums.mass;
  const Eigen::Vector3d velocity = velocity_of(simulation_.scene().bodies[body]);
  return velocity.norm() > 0 ? moved.dot(velocity.normalized()) : moved.norm();
}

double RunHistory::axis_angle(std::size_t body) const
{
  const tasks::BodyAxis& axis = *simulation_.scene().bodies[body].axis;
  const tasks::BodySums& sums = report_.bodies[body];
  const Eigen::Vector3d along =
      sums.rotation() * (Eigen::Vector3d(axis.nose.data()) - Eigen::Vector3d(axis.tail.data()));
  return portable::asin(-along[simulation_.scene().grid.dimension - 1] / along.norm()) * 180 / std::numbers::pi;
}

void RunHistory::add_body(std::size_t body, const std::vector<tasks::ContactForce>& forces,
                          std::vector<double>& row) const
{
  const int dimension = simulation_.scene().grid.dimension;
  const tasks::SceneBody& given = simulation_.scene().bodies[body];
  const tasks::BodySums& sums = report_.bodies[body];
  const auto add = [&](const Eigen::Vector3d& v) { row.insert(row.end(), v.data(), v.data() + dimension); };
  const auto first = static_cast<std::ptrdiff_t>(row.size());
  row.push_back(depth(body));
  add(sums.momentum / sums.mass);
  row.push_back(sums.tilt(dimension) * 180 / std::numbers::pi);
  if (dimension == 3) add(sums.spin());
  const tasks::ContactForce& contact = forces[static_cast<std::size_t>(given.material)];
  add(contact.force);
  if (given.drive) dimension == 3 ? add(contact.torque) : row.push_back(contact.torque.z());
  if (given.axis) {
    add(sums.place_of(Eigen::Vector3d(given.axis->nose.data())));
    add(sums.place_of(Eigen::Vector3d(given.axis->tail.data())));
    row.push_back(axis_angle(body));
  }
  // Nothing is known of a body that has left; the sign of what is not a number would be chance.
  if (sums.mass == 0) std::fill(row.begin() + first, row.end(), std::numeric_limits<double>::quiet_NaN());
}

void RunHistory::add_peaks(std::size_t material, const tasks::MaterialPeaks& peaks, std::vector<double>& row) const
{
  row.insert(row.end(), {extreme_or_nothing(peaks.pressure), peaks.q});
  for_each_extreme(simulation_.scene().materials[material],
                   [&](std::size_t k, const components::StateExtreme& extreme, const auto&) {
                     row.push_back(extreme_or_nothing(peaks.extreme(k, extreme)));
                   });
}

void RunHistory::write_row()
{
  measure();
  const EnergyBalance& e = energies_;
  std::vector<double> row{static_cast<double>(simulation_.n_steps()),
                          simulation_.time(),
                          simulation_.last_step_size(),
                          e.kinetic,
                          e.elastic,
                          e.plastic,
                          e.viscous,
                          e.contact,
                          e.external,
                          e.total};
  const Eigen::Vector3d momentum = report_.momentum();
  for (int k = 0; k < simulation_.scene().grid.dimension; ++k) row.push_back(momentum[k]);
  const std::vector<tasks::ContactForce> forces = simulation_.take_contact_forces();
  for (const std::size_t b : tracked_) add_body(b, forces, row);
  const std::size_t n_materials = simulation_.scene().materials.size();
  for (std::size_t m = 0; m < n_materials; ++m) add_peaks(m, report_.materials[m], row);
  if (simulation_.scene().has_nose()) {
    for (std::size_t m = 0; m < n_materials; ++m) add_peaks(m, near_noses_.materials[m], row);
  }
  row.insert(row.end(), {static_cast<double>(lost_.count), lost_.mass});
  row.insert(row.end(), lost_.momentum.data(), lost_.momentum.data() + simulation_.scene().grid.dimension);
  runtime::by_first(simulation_.communicator(), [&] { csv_->write_row(row); });
}

}  // namespace tamp::tools
