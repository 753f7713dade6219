#include "tools/compare/comparison.hpp"

#include <algorithm>

namespace tamp::tools::compare
{

std::optional<Quartiles> ratio_to_table(const Comparison& comparison, const ModelResult& model)
{
  const auto table = std::find_if(comparison.models.begin(), comparison.models.end(),
                                  [](const ModelResult& other) { return other.name == "table"; });
  if (table == comparison.models.end()) return std::nullopt;
  std::vector<double> ratios;
  for (std::size_t r = 0; r < std::min(model.rounds.size(), table->rounds.size()); ++r) {
    if (model.rounds[r].steps == 0 || table->rounds[r].steps == 0) continue;
    ratios.push_back(model.rounds[r].step_wall / table->rounds[r].step_wall);
  }
  if (ratios.empty()) return std::nullopt;
  return quartiles(std::move(ratios));
}

double largest(const ModelResult& model, std::vector<double> Sample::*kind)
{
  double most = 0;
  for (const Sample& sample : model.samples) {
    for (const double value : sample.*kind) most = std::max(most, value);
  }
  return most;
}

}  // namespace tamp::tools::compare
