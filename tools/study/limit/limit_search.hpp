#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp::tools::study
{

/// How the limit of a setting is looked for.
struct LimitSearch {
  /// Values between which it lies; without them they are looked for from the value as written on, each twice the one
  /// before where that is stable, or else half of it.
  std::optional<std::pair<double, double>> between{};
  /// How far apart the last stable and the first unstable value may be, relative to the smaller.
  double within = 0.02;
  int most_runs = 20;
};

/// A run with one value of the setting.
struct Probe {
  enum class Verdict {
    stable,
    unstable,
    no_answer  ///< refused, or out of time
  };
  double value = 0;
  Verdict verdict = Verdict::stable;
  /// Why it is not stable, or why that is not known, in words.
  std::string why{};
  std::string command{};
  /// Relative error of the energy, and the error of the quantity that is judged, of a run that was done.
  std::optional<double> energy_error{}, error{};
};

std::string to_text(Probe::Verdict verdict);

/// The two neighbours among the probes of which one is stable and the other is not.
struct Edge {
  Probe stable, unstable;
};

/// The limit that was found with one method.
struct Limit {
  std::string method;
  double written = 0;
  /// In the order in which they ran, the value as written first.
  std::vector<Probe> probes{};
  /// The edge that is nearest to the value as written; empty where `note` says why there is none.
  std::optional<Edge> edge{};
  std::string note{};
};

/// Bisects for the limit, in equal ratios.
Limit search_limit(const std::string& method, double written, const LimitSearch& search,
                   const std::function<Probe(double)>& try_value);

}  // namespace tamp::tools::study
