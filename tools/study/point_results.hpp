#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/scene/json/document.hpp"
#include "tools/study/study.hpp"

namespace tamp::tools::study
{

/// Why a point ended.
enum class End { done, limit, unstable, refused };

std::string to_text(End end);

/// Cost of one run of a point, by the keys of `cost_kinds`.
using Cost = std::map<std::string, double>;

/// A kind of cost; the first of a study is its charts' axis.
struct CostKind {
  std::string key, name, unit;
};
std::vector<CostKind> cost_kinds(Measure::Kind kind);

/// The columns of a point's `history.csv` by name; NaN where a row has no number.
using Columns = std::map<std::string, std::vector<double>>;

/// Result of a point. It is kept in a folder of its own, with what the point wrote: `history.csv` and
/// `summary.json`.
struct PointResult {
  End end = End::done;
  /// In words where it is not done.
  std::string reason;
  /// Costs of every timing.
  std::vector<Cost> costs;
  /// The processor time that it was given [s].
  double limit = 0;
  std::filesystem::path folder;

  /// Read when they are first asked for. Throws FileError where they cannot be, as where a row lacks a number.
  const Columns& columns() const;

  /// Median, least and greatest of a cost; empty where it is not known.
  struct Spread {
    double median, least, greatest;
  };
  std::optional<Spread> cost(const std::string& key) const;

  /// Cache of `columns`.
  mutable std::shared_ptr<const Columns> read_columns{};
};

/// The result that a folder keeps of the point with its name, the key of its measurement; empty where there is no such
/// folder. Throws FileError, which names the file, where one of the folder's files is not what was written.
std::optional<PointResult> read_result(const std::filesystem::path& folder);
/// The summary.json that a run wrote in a folder. Throws FileError where it cannot be read.
Json summary_in(const std::filesystem::path& folder);
/// Keeps the result of the point with this key in its folder, with checksums of all that is there.
void write_result(const PointResult& result, const std::string& key);

}  // namespace tamp::tools::study
