#include "tools/study/compare/comparison.hpp"

#include <algorithm>
#include <limits>

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

double common_time(const Comparison& comparison)
{
  double time = std::numeric_limits<double>::infinity();
  for (const ModelResult& model : comparison.models) time = std::min(time, model.samples.back().time);
  return time;
}

namespace
{

/// Interpolates `value(sample)` in time.
template <class Value>
double value_at(const ModelResult& model, double time, const Value& value)
{
  const auto after = std::find_if(model.samples.begin(), model.samples.end(),
                                  [&](const Sample& sample) { return sample.time >= time; });
  if (after == model.samples.end()) return std::numeric_limits<double>::quiet_NaN();
  if (after == model.samples.begin() || after->time == time) return value(*after);
  const Sample& before = *(after - 1);
  const double part = (time - before.time) / (after->time - before.time);
  return value(before) + part * (value(*after) - value(before));
}

double largest_of(const std::vector<double>& values)
{
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : *std::max_element(values.begin(), values.end());
}

}  // namespace

double depth_at(const ModelResult& model, double time)
{
  return value_at(model, time, [](const Sample& sample) {
    return sample.depth.empty() ? std::numeric_limits<double>::quiet_NaN() : sample.depth.front();
  });
}

double q_at(const ModelResult& model, double time)
{
  return value_at(model, time, [](const Sample& sample) { return largest_of(sample.q); });
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
