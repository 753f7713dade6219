#include "tools/study/compare/model_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/scene/json/print_json.hpp"

namespace tamp::tools::compare
{

namespace
{

std::vector<std::size_t> sands_of(const tasks::Scene& scene)
{
  std::vector<std::size_t> sands;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (std::holds_alternative<components::TabularCap>(scene.materials[m].model)) sands.push_back(m);
  }
  return sands;
}

}  // namespace

ModelRun::ModelRun(const ModelScene& scene, const Extent& extent, const std::filesystem::path& folder,
                   std::shared_ptr<runtime::Executor> executor)
    : extent_(extent),
      simulation_(tasks::Simulation::make(scene.scene.scene, std::move(executor))),
      history_(*simulation_),
      sands_(sands_of(simulation_->scene()))
{
  history_.begin(folder);
  runtime::write_whole_file(folder / "scene.json", json_text(scene.scene.resolved, 2) + "\n");
  result_.name = scene.name;
  add_sample();
}

bool ModelRun::finished() const
{
  return result_.unstable() || simulation_->time() >= extent_.end || simulation_->n_steps() >= extent_.max_steps;
}

double ModelRun::progress() const
{
  if (finished()) return 1;
  return std::max(simulation_->time() / extent_.end,
                  static_cast<double>(simulation_->n_steps()) / static_cast<double>(extent_.max_steps));
}

void ModelRun::advance_steps(int n_steps)
{
  const long last = simulation_->n_steps() + n_steps;
  advance_while([&] { return simulation_->n_steps() < last; });
}

void ModelRun::advance_to(double until)
{
  advance_while([&] { return simulation_->time() < until; });
}

template <class Wanted>
void ModelRun::advance_while(const Wanted& wanted)
{
  const auto n_before = static_cast<std::ptrdiff_t>(step_walls_.size());
  while (!finished() && wanted()) step();
  const std::vector<double> walls(step_walls_.begin() + n_before, step_walls_.end());
  result_.rounds.push_back({simulation_->time(), static_cast<long>(walls.size()), median(walls)});
}

void ModelRun::step()
{
  const auto start = std::chrono::steady_clock::now();
  try {
    simulation_->advance(extent_.end);
  } catch (const tasks::SimulationError& error) {
    result_.instability =
        fmt::format("step {}, time {:.6g} s: {}", simulation_->n_steps(), simulation_->time(), error.what());
    if (result_.samples.back().time < simulation_->time()) add_sample();
    return;
  }
  step_walls_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  result_.wall += step_walls_.back();
  expect_energy();
  if (simulation_->time() >= next_sample_ || finished()) add_sample();
}

void ModelRun::expect_energy()
{
  const std::string problem = history_.energy_problem(simulation_->scene().limits.energy_error);
  if (problem.empty()) return;
  result_.instability = fmt::format("step {}, time {:.6g} s: {}", simulation_->n_steps(), simulation_->time(), problem);
}

void ModelRun::add_sample()
{
  history_.write_row();
  Sample sample{simulation_->time(), simulation_->last_step_size(), result_.wall, {}, {}, {}};
  for (const std::size_t body : history_.tracked_bodies()) sample.depth.push_back(history_.depth(body));
  for (const std::size_t sand : sands_) {
    sample.pressure.push_back(history_.report().materials[sand].pressure);
    sample.q.push_back(history_.report().materials[sand].q);
  }
  result_.samples.push_back(std::move(sample));
  const double interval = simulation_->scene().output.history_interval;
  next_sample_ = (std::floor(simulation_->time() / interval) + 1) * interval;
}

ModelResult ModelRun::result()
{
  result_.steps = simulation_->n_steps();
  result_.time = simulation_->time();
  result_.median_step_wall = median(step_walls_);
  result_.modulus_evaluations = simulation_->updates().modulus_evaluations;
  if (!modulus_ns_.empty()) result_.modulus_ns = median(modulus_ns_);
  result_.ledger_peak_bytes = simulation_->engine().warehouse().ledger().total().peak();
  result_.digest = simulation_->digest();
  return result_;
}

}  // namespace tamp::tools::compare
