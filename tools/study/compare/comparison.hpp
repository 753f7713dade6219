#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/system/statistics.hpp"

namespace tamp::tools::compare
{

/// Cost of one model's steps in one round; in the same round all models go through the same simulated time.
struct Round {
  double time;  ///< at its end [s]
  long steps;
  double step_wall;  ///< median of its steps [s]; 0 without a step
};

/// Plotted values of the state at one moment.
struct Sample {
  double time;                   ///< [s]
  double step_size;              ///< of the last step [s]
  double wall;                   ///< in all steps so far [s]
  std::vector<double> depth;     ///< of each tracked body [m]
  std::vector<double> pressure;  ///< largest of each sand, compression positive [Pa]
  std::vector<double> q;         ///< [Pa]
};

/// All that is kept of one model.
struct ModelResult {
  std::string name;
  /// Why the simulation went wrong; empty where it did not.
  std::string instability;
  long steps = 0;
  double time = 0;              ///< simulated [s]
  double wall = 0;              ///< in all steps [s]
  double median_step_wall = 0;  ///< [s]
  std::vector<Round> rounds;    ///< one for every round of the comparison, empty ones too
  std::vector<Sample> samples;
  std::size_t modulus_evaluations = 0;
  std::optional<double> modulus_ns;  ///< time of one evaluation, over the states of its own sand [ns]
  std::size_t ledger_peak_bytes = 0;
  /// Peak memory of a process that runs this model alone for a few steps.
  std::optional<std::size_t> peak_rss_bytes;
  std::string digest;

  bool unstable() const { return !instability.empty(); }
  double mean_step_size() const { return steps > 0 ? time / static_cast<double>(steps) : 0; }
};

struct Comparison {
  std::string scene;
  std::string title;
  std::size_t n_particles = 0;
  int n_threads = 1;
  std::vector<std::string> bodies;  ///< tracked
  std::vector<std::string> sands;
  std::vector<ModelResult> models;
  /// The first model on cells twice as large, up to the common time.
  std::optional<ModelResult> coarser{};
};

/// The cost of a step against that of the first plain table, round by round: noise that lasts for more than a round
/// divides out. None if there is no table, or no round in which both made steps.
std::optional<Quartiles> ratio_to_table(const Comparison& comparison, const ModelResult& model);

/// The last time that all models have reached [s]: only up to there can they be compared.
double common_time(const Comparison& comparison);

/// The depth of the first tracked body, and the largest q of all sands, at a time, straight between samples. NaN where
/// there is none.
double depth_at(const ModelResult& model, double time);
double q_at(const ModelResult& model, double time);

/// The largest value of a kind over all sands, or all bodies, and samples; not below 0.
double largest(const ModelResult& model, std::vector<double> Sample::*kind);

}  // namespace tamp::tools::compare
