#include "tools/study/compare/compare.hpp"

#include <algorithm>
#include <memory>

#include "tools/run/progress.hpp"
#include "tools/study/compare/model_run.hpp"

namespace tamp::tools::compare
{

namespace
{

/// Steps of a round's leader: enough for the caches to be the model's own, and few enough that there are many rounds.
int steps_a_round(long max_steps)
{
  return static_cast<int>(std::clamp(max_steps / 20, 1L, 20L));
}

std::size_t n_particles(const tasks::Simulation& simulation)
{
  std::size_t n = 0;
  for (std::size_t m = 0; m < simulation.scene().materials.size(); ++m) {
    n += simulation.n_particles(static_cast<int>(m));
  }
  return n;
}

class Race
{
 public:
  Race(const std::vector<ModelScene>& scenes, const Options& options)
      : options_(options),
        extent_{std::min(scenes.front().scene.scene.time.end, options.until), options.max_steps},
        round_steps_(steps_a_round(options.max_steps))
  {
    const auto executor = std::make_shared<runtime::Executor>(options.n_threads);
    for (const ModelScene& scene : scenes) {
      runs_.push_back(std::make_unique<ModelRun>(scene, extent_, options.folder / scene.name, executor));
    }
  }

  void run()
  {
    Progress progress(options_.quiet, extent_.end, most_steps_of_all(), n_particles(runs_.front()->simulation()));
    time_moduli_when_due();
    for (std::size_t round = 0; least_progress() < 1; ++round) {
      run_round(round, progress);
      time_moduli_when_due();
    }
    progress.finish();
  }

  Comparison comparison()
  {
    const tasks::Simulation& first = runs_.front()->simulation();
    const tasks::Scene& scene = first.scene();
    Comparison all{scene.name, scene.title, n_particles(first), options_.n_threads, {}, {}, {}};
    for (const std::size_t b : runs_.front()->history().tracked_bodies()) all.bodies.push_back(scene.bodies[b].name);
    for (const tasks::SceneMaterial& material : scene.materials) {
      if (std::holds_alternative<components::TabularCap>(material.model)) all.sands.push_back(material.name);
    }
    for (const auto& run : runs_) all.models.push_back(run->result());
    return all;
  }

 private:
  void run_round(std::size_t round, Progress& progress)
  {
    std::vector<ModelRun*> order;
    for (std::size_t k = 0; k < runs_.size(); ++k) order.push_back(runs_[(round + k) % runs_.size()].get());
    const auto leader = std::find_if(order.begin(), order.end(), [](const ModelRun* run) { return !run->finished(); });
    std::rotate(order.begin(), leader, order.end());
    for (ModelRun* run : order) {
      if (run == order.front()) {
        run->advance_steps(round_steps_);
      } else {
        run->advance_to(order.front()->simulation().time());
      }
      const tasks::Simulation& simulation = run->simulation();
      progress.show(steps_of_all(), simulation.time(), simulation.last_step_size());
    }
  }

  double least_progress() const
  {
    double least = 1;
    for (const auto& run : runs_) least = std::min(least, run->progress());
    return least;
  }

  long most_steps_of_all() const
  {
    constexpr long no_limit = std::numeric_limits<long>::max();
    const auto n_models = static_cast<long>(runs_.size());
    return extent_.max_steps < no_limit / n_models ? extent_.max_steps * n_models : no_limit;
  }

  long steps_of_all() const
  {
    long steps = 0;
    for (const auto& run : runs_) steps += run->simulation().n_steps();
    return steps;
  }

  /// Times the moduli at the start, at the end and three times between, models in turn.
  void time_moduli_when_due()
  {
    if (least_progress() < next_timing_) return;
    while (next_timing_ <= least_progress()) next_timing_ += 0.25;
    std::vector<std::vector<ModulusTiming>> timings;
    for (const auto& run : runs_) timings.push_back(run->modulus_timings());
    constexpr int n_passes = 9;
    for (int pass = 0; pass < n_passes; ++pass) {
      for (std::size_t k = 0; k < runs_.size(); ++k) runs_[k]->add_modulus_ns(nanoseconds_each(timings[k]));
    }
  }

  const Options& options_;
  Extent extent_;
  int round_steps_;
  double next_timing_ = 0;
  std::vector<std::unique_ptr<ModelRun>> runs_;
};

}  // namespace

std::vector<std::unique_ptr<RunFolder>> prepare_folders(const Options& options, const std::vector<ModelScene>& scenes)
{
  const auto use = options.force ? RunFolder::Use::replace : RunFolder::Use::begin;
  std::vector<std::filesystem::path> inputs;
  for (const ModelScene& scene : scenes) {
    for (const InputFile& input : scene.scene.inputs) inputs.push_back(input.file);
  }
  std::vector<std::unique_ptr<RunFolder>> folders;
  folders.push_back(std::make_unique<RunFolder>(options.folder, use, inputs));
  for (const ModelScene& scene : scenes) {
    folders.push_back(std::make_unique<RunFolder>(options.folder / scene.name, use, inputs));
  }
  return folders;
}

Comparison compare(const std::vector<ModelScene>& scenes, const Options& options)
{
  Race race(scenes, options);
  race.run();
  return race.comparison();
}

}  // namespace tamp::tools::compare
