#include "tools/study/point_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <span>
#include <stdexcept>

#include "runtime/file_error.hpp"
#include "runtime/storage/checksum.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/tables/csv_table.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::study
{

namespace
{

namespace fs = std::filesystem;
using runtime::FileError;

constexpr const char* result_file = "result.json";
constexpr std::array<const char*, 4> end_words{"done", "limit", "unstable", "refused"};

End end_of(const std::string& word)
{
  const auto at = std::find(end_words.begin(), end_words.end(), word);
  if (at == end_words.end()) throw std::out_of_range(word);
  return static_cast<End>(at - end_words.begin());
}

/// Read in pieces, as fields may be larger than memory.
std::string hash_of_file(const fs::path& file)
{
  std::error_code none;
  const fs::file_status status = fs::status(file, none);
  if (!fs::exists(status)) throw FileError(file.string(), "is missing");
  if (!fs::is_regular_file(status)) throw FileError(file.string(), "is no file");
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 20);
  std::uint64_t sum = 0;
  while (stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    sum = runtime::checksum(std::as_bytes(std::span(piece.data(), static_cast<std::size_t>(stream.gcount()))), sum);
  }
  if (!stream.eof()) throw FileError(file.string(), "cannot be read");
  return fmt::format("{:016x}", sum);
}

/// Checksums of the files beside the result.
Json hashes_in(const fs::path& folder)
{
  Json hashes = Json::object();
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name != result_file) hashes[name] = hash_of_file(entry.path());
  }
  return hashes;
}

/// The content of a result's file, once it is known to be what was written.
Json sound_content(const fs::path& folder)
{
  const fs::path file = folder / result_file;
  Json content = parse_json(file);
  if (!content.is_object() || !content.contains("checksum")) throw FileError(file.string(), "has no checksum");
  const Json checksum = content["checksum"];
  content.erase("checksum");
  if (checksum != hash_of(json_text(content))) throw FileError(file.string(), "is not what its checksum says");
  if (content.at("key") != folder.filename().string()) throw FileError(file.string(), "is of another point");
  for (const auto& [name, hash] : content.at("files").items()) {
    if (hash_of_file(folder / name) != hash) throw FileError((folder / name).string(), "is not what was written");
  }
  return content;
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
    try {
      for (auto& [name, values] : numbers_by_column(folder / "history.csv")) columns[name] = std::move(values);
    } catch (const InputError& error) {
      throw FileError(error.problems.front().place, error.problems.front().found);
    }
    read_columns = std::make_shared<const Columns>(std::move(columns));
  }
  return *read_columns;
}

std::optional<PointResult> read_result(const fs::path& folder)
{
  std::error_code none;
  if (!fs::exists(fs::symlink_status(folder, none))) return std::nullopt;
  const std::string file = (folder / result_file).string();
  try {
    const Json json = sound_content(folder);
    PointResult result{end_of(json.at("ended")), json.at("reason"), json.at("costs").get<std::vector<Cost>>(),
                       json.at("limit_s").is_null() ? HUGE_VAL : json.at("limit_s").get<double>(), folder};
    if (!result.cost("core_s")) throw FileError(file, "has no time");
    return result;
  } catch (const InputError& error) {
    throw FileError(file, error.problems.front().found);
  } catch (const Json::exception&) {
    throw FileError(file, "is no result");
  } catch (const std::out_of_range&) {
    throw FileError(file, "is no result");
  }
}

Json summary_in(const fs::path& folder)
{
  const fs::path file = folder / "summary.json";
  Json summary = Json::parse(std::ifstream(file), nullptr, false);
  if (summary.is_discarded()) throw FileError(file.string(), "cannot be read");
  return summary;
}

void write_result(const PointResult& result, const std::string& key)
{
  Json content{{"key", key},
               {"ended", to_text(result.end)},
               {"reason", utf8(result.reason)},
               {"limit_s", std::isfinite(result.limit) ? Json(result.limit) : Json(nullptr)},
               {"costs", result.costs},
               {"files", hashes_in(result.folder)}};
  content["checksum"] = hash_of(json_text(content));
  runtime::write_whole_file(result.folder / result_file, json_text(content, 1) + "\n");
}

}  // namespace tamp::tools::study
