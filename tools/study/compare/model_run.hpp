#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "tasks/simulation.hpp"
#include "tools/run/modulus/modulus_timing.hpp"
#include "tools/run/run_history.hpp"
#include "tools/study/compare/comparison.hpp"
#include "tools/study/compare/model_scenes.hpp"

namespace tamp::tools::compare
{

/// The length of every model's run.
struct Extent {
  double end;  ///< [s]
  long max_steps;
};

/// A model of a comparison, in time: its simulation, and what is kept of it. A simulation that goes wrong ends there.
class ModelRun
{
 public:
  /// `folder` exists, and receives the scene as resolved and `history.csv`. All models of a comparison share one
  /// executor: each one's own would keep its threads from the others.
  ModelRun(const ModelScene& scene, const Extent& extent, const std::filesystem::path& folder,
           std::shared_ptr<runtime::Executor> executor);

  /// Runs so many steps, or to a simulated time; both end early where the run does.
  void advance_steps(int n_steps);
  void advance_to(double until);

  bool finished() const;
  /// The part of the run that is done, 0 to 1.
  double progress() const;
  const tasks::Simulation& simulation() const { return *simulation_; }
  const RunHistory& history() const { return history_; }

  /// The states of the sand now; the last good ones of a run that went wrong.
  std::vector<ModulusTiming> modulus_timings() { return compare::modulus_timings(*simulation_); }
  void add_modulus_ns(double ns) { modulus_ns_.push_back(ns); }

  ModelResult result();

 private:
  void step();
  void expect_energy();
  void add_sample();
  template <class Wanted>
  void advance_while(const Wanted& wanted);

  Extent extent_;
  std::unique_ptr<tasks::Simulation> simulation_;
  RunHistory history_;
  std::vector<std::size_t> sands_;
  double next_sample_ = 0;
  std::vector<double> step_walls_;
  std::vector<double> modulus_ns_;
  ModelResult result_;
};

}  // namespace tamp::tools::compare
