#include "tools/study/point_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "runtime/storage/whole_file.hpp"
#include "tools/scene/csv_table.hpp"
#include "tools/statistics.hpp"

namespace tamp::tools::study
{

namespace
{

constexpr const char* result_file = "result.json";
constexpr std::array<const char*, 4> end_words{"done", "limit", "unstable", "refused"};

End end_of(const std::string& word)
{
  const auto at = std::find(end_words.begin(), end_words.end(), word);
  if (at == end_words.end()) throw std::out_of_range(word);
  return static_cast<End>(at - end_words.begin());
}

}  // namespace

std::string to_text(End end)
{
  return end_words.at(static_cast<std::size_t>(end));
}

std::vector<CostKind> cost_kinds(Measure::Kind kind)
{
  switch (kind) {
    case Measure::Kind::run:
      return {{"core_s", "user time", "s"}, {"particle_steps", "particle-steps", ""}};
    case Measure::Kind::drive:
      return {{"ns_per_update", "time of an update", "ns"},
              {"evaluations_per_update", "modulus evaluations an update", ""}};
    case Measure::Kind::modulus:
      return {{"ns_per_evaluation", "time of an evaluation", "ns"}};
  }
  return {};
}

std::optional<PointResult::Spread> PointResult::cost(const std::string& key) const
{
  std::vector<double> values;
  for (const Cost& one : costs) {
    if (const auto at = one.find(key); at != one.end()) values.push_back(at->second);
  }
  if (values.empty()) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return Spread{median(values), *least, *greatest};
}

const Columns& PointResult::columns() const
{
  if (!read_columns) {
    Columns columns;
    for (auto& [name, values] : numbers_by_column(folder / "history.csv")) columns[name] = std::move(values);
    read_columns = std::make_shared<const Columns>(std::move(columns));
  }
  return *read_columns;
}

std::optional<PointResult> read_result(const std::filesystem::path& folder)
{
  try {
    const Json json = Json::parse(std::ifstream(folder / result_file));
    PointResult result{end_of(json.at("ended")), json.at("reason"), json.at("costs").get<std::vector<Cost>>(),
                       json.at("limit_s").is_null() ? HUGE_VAL : json.at("limit_s").get<double>(), folder};
    if (!result.cost("core_s")) return std::nullopt;
    return result;
  } catch (const Json::exception&) {  // none, or not what was written
    return std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

void write_result(const PointResult& result)
{
  const Json json{
      {"ended", to_text(result.end)}, {"reason", result.reason}, {"limit_s", result.limit}, {"costs", result.costs}};
  runtime::write_whole_file(result.folder / result_file, json.dump(1) + "\n");
}

}  // namespace tamp::tools::study
