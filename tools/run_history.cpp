#include "tools/run_history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "runtime/ranks/together.hpp"

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
    if (velocity_of(scene.bodies[b]).norm() > 0) moving.push_back(b);
  }
  return moving;
}

bool is_sand(const tasks::SceneMaterial& material)
{
  return std::holds_alternative<components::TabularCap>(material.model);
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

void RunHistory::go_on(const std::filesystem::path& folder, long kept_until)
{
  runtime::by_first(simulation_.communicator(),
                    [&] { csv_ = runtime::CsvWriter::continued(folder / "history.csv", columns(), kept_until); });
}

std::vector<std::string> RunHistory::columns() const
{
  const tasks::Scene& scene = simulation_.scene();
  const auto dimension = static_cast<std::size_t>(scene.grid.dimension);
  std::vector<std::string> names{"step",       "time[s]",    "dt[s]",      "kinetic[J]",  "elastic[J]",
                                 "plastic[J]", "viscous[J]", "contact[J]", "external[J]", "total[J]"};
  for (std::size_t k = 0; k < dimension; ++k) names.push_back(std::string("momentum_") + axis_names[k] + "[N s]");
  for (const std::size_t b : tracked_) {
    const std::string& body = scene.bodies[b].name;
    names.push_back(body + ".depth[m]");
    for (std::size_t k = 0; k < dimension; ++k) names.push_back(body + ".velocity_" + axis_names[k] + "[m/s]");
    names.push_back(body + ".tilt[deg]");
  }
  for (const tasks::SceneMaterial& m : scene.materials) {
    names.insert(names.end(), {m.name + ".p_max[Pa]", m.name + ".q_max[Pa]"});
    if (!is_sand(m)) continue;
    names.insert(names.end(), {m.name + ".cap_max[Pa]", m.name + ".plastic_volumetric_max[-]",
                               m.name + ".plastic_volumetric_min[-]"});
  }
  names.push_back("lost[particles]");
  return names;
}

void RunHistory::measure()
{
  report_ = simulation_.report();
  lost_ = simulation_.lost();
  const tasks::StepTotals& totals = simulation_.totals();
  EnergyBalance& e = energies_;
  e = {report_.kinetic,
       totals.elastic,
       totals.plastic,
       totals.viscous,
       totals.contact,
       report_.gravity_work - initial_.gravity_work,
       0};
  e.total = e.kinetic + e.elastic + e.plastic + e.viscous + e.contact - e.external;
  const double largest =
      std::max({e.kinetic, std::abs(e.elastic), e.plastic, e.viscous, e.contact, std::abs(e.external)});
  const double energy_scale = initial_.kinetic > 0 ? initial_.kinetic : largest;
  energy_error_ = energy_scale > 0 ? std::abs(e.total - initial_.kinetic) / energy_scale : 0;

  double momentum_scale = 0;
  for (std::size_t b = 0; b < simulation_.scene().bodies.size(); ++b) {
    momentum_scale += std::max(initial_.bodies[b].momentum.norm(), report_.bodies[b].momentum.norm());
  }
  const Eigen::Vector3d given(simulation_.impulse().value.data());
  const Eigen::Vector3d change = report_.momentum() + lost_.momentum - initial_.momentum();
  momentum_error_ = momentum_scale > 0 ? (change - given).norm() / momentum_scale : 0;
}

double RunHistory::depth(std::size_t body) const
{
  const tasks::BodySums& sums = report_.bodies[body];
  const Eigen::Vector3d moved = (sums.position - sums.reference_position) / sums.mass;
  return moved.dot(velocity_of(simulation_.scene().bodies[body]).normalized());
}

void RunHistory::add_body(std::size_t body, std::vector<double>& row) const
{
  const tasks::BodySums& sums = report_.bodies[body];
  row.push_back(depth(body));
  for (int k = 0; k < simulation_.scene().grid.dimension; ++k) row.push_back(sums.momentum[k] / sums.mass);
  row.push_back(sums.tilt() * 180 / std::numbers::pi);
}

void RunHistory::add_material(std::size_t material, std::vector<double>& row) const
{
  const tasks::MaterialPeaks& peaks = report_.materials[material];
  row.insert(row.end(), {peaks.pressure, peaks.q});
  if (!is_sand(simulation_.scene().materials[material])) return;
  row.insert(row.end(), {peaks.cap, peaks.plastic_volumetric, peaks.least_plastic_volumetric});
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
  for (const std::size_t b : tracked_) add_body(b, row);
  for (std::size_t m = 0; m < simulation_.scene().materials.size(); ++m) add_material(m, row);
  row.push_back(static_cast<double>(lost_.count));
  runtime::by_first(simulation_.communicator(), [&] { csv_->write_row(row); });
}

}  // namespace tamp::tools
