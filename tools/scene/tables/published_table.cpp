#include "tools/scene/tables/published_table.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/scene/json/parse_json.hpp"

namespace tamp::tools
{

namespace
{

constexpr const char* root_key = "Vaango_tabular_data";
constexpr const char* level_key = "Data";

class PublishedTableReader
{
 public:
  explicit PublishedTableReader(const std::filesystem::path& file) { table_.file = file; }

  PublishedTable read()
  {
    const Json root = parse_json(table_.file);
    const JsonPointer start = JsonPointer() / root_key / level_key;
    if (root.contains(start) && root[start].is_object()) {
      read_data(root[start], start, {});
    } else {
      add(start, "missing", "expected an object with the lists of a table");
    }
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(table_);
  }

 private:
  std::string place(const JsonPointer& pointer) const { return table_.file.string() + "#" + pointer.to_string(); }

  void add(const JsonPointer& pointer, const std::string& found, const std::string& expected)
  {
    problems_.push_back({place(pointer), found, expected});
  }

  void read_data(const Json& data, const JsonPointer& pointer, const std::vector<double>& at)
  {
    if (data.contains(level_key)) {
      read_level(data, pointer, at);
    } else {
      read_curve(data, pointer, at);
    }
  }

  void read_level(const Json& data, const JsonPointer& pointer, std::vector<double> at)
  {
    const Json& inner = data[level_key];
    if (!inner.is_array() || data.size() != 2) {
      add(pointer, fmt::format("{} names beside \"Data\"", data.size() - 1), "expected one, and \"Data\" to be a list");
      return;
    }
    const std::string name = data.begin().key() == level_key ? std::next(data.begin()).key() : data.begin().key();
    const std::vector<double> numbers = read_numbers(data[name], pointer / name);
    if (numbers.size() != inner.size()) {
      add(pointer / level_key, fmt::format("{} entries", inner.size()),
          fmt::format("expected {}, one for each number of {}", numbers.size(), name));
      return;
    }
    if (!note_level(at.size(), name, numbers.size())) {
      add(pointer / name, "another name than in the entries before", "expected " + table_.levels[at.size()].name);
      return;
    }
    at.push_back(0);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      at.back() = numbers[i];
      if (inner[i].is_object()) {
        read_data(inner[i], pointer / level_key / i, at);
      } else {
        add(pointer / level_key / i, inner[i].type_name(), "expected an object");
      }
    }
  }

  /// False if the level at this depth goes by another name.
  bool note_level(std::size_t depth, const std::string& name, std::size_t n_entries)
  {
    if (depth == table_.levels.size()) table_.levels.push_back({name, 0});
    PublishedTable::Level& level = table_.levels[depth];
    level.n_entries = std::max(level.n_entries, n_entries);
    return level.name == name;
  }

  void read_curve(const Json& data, const JsonPointer& pointer, const std::vector<double>& at)
  {
    const std::size_t n_before = problems_.size();
    PublishedTable::Curve curve{place(pointer), at, {}};
    for (const auto& [name, list] : data.items()) curve.lists[name] = read_numbers(list, pointer / name);
    if (problems_.size() == n_before) check_lengths(curve.lists, pointer);
    table_.curves.push_back(std::move(curve));
  }

  void check_lengths(const std::map<std::string, std::vector<double>>& lists, const JsonPointer& pointer)
  {
    const std::size_t n_points = lists.empty() ? 0 : lists.begin()->second.size();
    if (n_points < 2) add(pointer, fmt::format("a curve of {} points", n_points), "expected at least two");
    for (const auto& [name, numbers] : lists) {
      if (numbers.size() == n_points) continue;
      add(pointer / name, fmt::format("{} numbers", numbers.size()),
          fmt::format("expected {}, as of {}", n_points, lists.begin()->first));
    }
  }

  /// Reports only the first entry that is no number.
  std::vector<double> read_numbers(const Json& list, const JsonPointer& pointer)
  {
    if (!list.is_array()) {
      add(pointer, list.type_name(), "expected a list of numbers");
      return {};
    }
    const auto bad = std::find_if(list.begin(), list.end(), [](const Json& v) { return !v.is_number(); });
    if (bad == list.end()) return list.get<std::vector<double>>();
    add(pointer / static_cast<std::size_t>(bad - list.begin()), bad->dump(), "expected a number");
    return std::vector<double>(list.size(), 0);
  }

  PublishedTable table_;
  std::vector<Problem> problems_;
};

}  // namespace

std::string PublishedTable::Curve::place_of(const std::string& name, std::ptrdiff_t row) const
{
  return row < 0 ? place : fmt::format("{}/{}/{}", place, name, row);
}

std::string PublishedTable::names() const
{
  std::vector<std::string> all;
  for (const Level& l : levels) all.push_back(fmt::format("{} ({} entries)", l.name, l.n_entries));
  if (!curves.empty()) {
    for (const auto& [name, list] : curves.front().lists) all.push_back(name);
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

std::size_t PublishedTable::level(const std::string& name) const
{
  const auto at = std::find_if(levels.begin(), levels.end(), [&](const Level& l) { return l.name == name; });
  return static_cast<std::size_t>(at - levels.begin());
}

bool PublishedTable::depends_on_no_level_but(const std::string& name) const
{
  return std::all_of(levels.begin(), levels.end(), [&](const Level& l) { return l.name == name || l.n_entries == 1; });
}

Problem PublishedTable::unsuitable(const std::string& expected) const
{
  return {fmt::format("{}#/{}/{}", file.string(), root_key, level_key), "a table of " + names(), expected};
}

PublishedTable read_published_table(const std::filesystem::path& file)
{
  return PublishedTableReader(file).read();
}

std::string published_name(const std::string& column)
{
  static const std::map<std::string, std::string> names{
      {"total_volumetric[-]", "TotalStrainVol"},     {"plastic_volumetric[-]", "PlasticStrainVol"},
      {"elastic_volumetric[-]", "ElasticStrainVol"}, {"pressure[Pa]", "Pressure"},
      {"bulk_modulus[Pa]", "BulkModulus"},           {"sqrt_J2[Pa]", "SqrtJ2"}};
  const auto at = names.find(column);
  return at == names.end() ? "" : at->second;
}

Table read_published_curve(const std::filesystem::path& file, const std::vector<std::string>& columns)
{
  PublishedTable published = read_published_table(file);
  std::vector<std::string> names(columns.size());
  std::transform(columns.begin(), columns.end(), names.begin(), published_name);
  const std::string expected = fmt::format("expected {}", fmt::join(names, ", "));

  if (published.curves.size() != 1) throw InputError(published.unsuitable(expected));
  PublishedTable::Curve& curve = published.curves.front();
  const auto has = [&](const std::string& name) { return curve.lists.contains(name); };
  if (curve.lists.size() != names.size() || !std::all_of(names.begin(), names.end(), has)) {
    throw InputError(published.unsuitable(expected));
  }

  Table table{file, {}, {}};
  const std::size_t n_rows = curve.lists.begin()->second.size();
  for (std::size_t i = 0; i < n_rows; ++i) {
    table.place_of_row.push_back(curve.place_of(names.front(), static_cast<std::ptrdiff_t>(i)));
  }
  for (const std::string& name : names) table.columns.push_back(std::move(curve.lists[name]));
  return table;
}

}  // namespace tamp::tools
