#include "tools/scene/csv_table.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "tools/scene/input_file.hpp"

namespace tamp::tools
{

namespace
{

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view blank = " \t\r";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string_view> split(std::string_view line)
{
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> finite_number(std::string_view text)
{
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Reads line by line into a table, noting what is wrong.
class TableReader
{
 public:
  TableReader(const std::filesystem::path& file, const std::vector<std::string>& columns) : wanted_(columns)
  {
    table_.file = file;
    table_.columns.resize(columns.size());
  }

  void read(std::string_view line)
  {
    ++line_;
    line = trimmed(line);
    if (line.empty() || line.front() == '#') return;
    if (place_in_line_.empty()) {
      read_header(split(line));
    } else {
      read_row(split(line));
    }
  }

  Table finished()
  {
    if (place_in_line_.empty()) {
      add("no line with the names of the columns", fmt::format("expected {}", fmt::join(wanted_, ",")));
    } else if (problems_.empty() && table_.n_rows() == 0) {
      add("a table without rows", "expected numbers");
    }
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(table_);
  }

 private:
  void add(const std::string& found, const std::string& expected)
  {
    constexpr std::size_t most = 1000;
    problems_.push_back({place(), found, expected});
    if (problems_.size() == most) throw InputError(std::move(problems_));
  }

  std::string place() const { return fmt::format("{}:{}", table_.file.string(), line_); }

  void read_header(const std::vector<std::string_view>& names)
  {
    for (const std::string& name : wanted_) {
      const auto at = std::find(names.begin(), names.end(), name);
      place_in_line_.push_back(static_cast<std::size_t>(at - names.begin()));
    }
    const bool all_found =
        std::all_of(place_in_line_.begin(), place_in_line_.end(), [&](std::size_t i) { return i < names.size(); });
    if (!all_found || names.size() != wanted_.size()) {
      add(fmt::format("columns {}", fmt::join(names, ",")), fmt::format("expected {}", fmt::join(wanted_, ",")));
      throw InputError(std::move(problems_));
    }
  }

  void read_row(const std::vector<std::string_view>& parts)
  {
    if (parts.size() != wanted_.size()) {
      add(fmt::format("{} values", parts.size()), fmt::format("expected {}", wanted_.size()));
      return;
    }
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const std::string_view text = parts[place_in_line_[i]];
      const std::optional<double> value = finite_number(text);
      if (!value) add(fmt::format("\"{}\" for {}", text, wanted_[i]), "expected a finite number");
      table_.columns[i].push_back(value.value_or(0));
    }
    table_.place_of_row.push_back(place());
  }

  const std::vector<std::string>& wanted_;
  Table table_;
  /// Where in a line each wanted column stands; empty before the header.
  std::vector<std::size_t> place_in_line_;
  std::vector<Problem> problems_;
  int line_ = 0;
};

}  // namespace

std::vector<std::pair<std::string, std::vector<double>>> numbers_by_column(const std::filesystem::path& file)
{
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  std::istringstream stream(read_input_file(file));
  for (std::string line; std::getline(stream, line);) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const std::vector<std::string_view> parts = split(content);
    const bool first = columns.empty();
    for (std::size_t i = 0; first && i < parts.size(); ++i) columns.emplace_back(parts[i], std::vector<double>{});
    for (std::size_t i = 0; !first && i < std::min(parts.size(), columns.size()); ++i) {
      columns[i].second.push_back(finite_number(parts[i]).value_or(NAN));
    }
  }
  return columns;
}

std::vector<std::pair<std::string, double>> greatest_of_columns(const std::filesystem::path& file)
{
  std::vector<std::pair<std::string, double>> all;
  for (const auto& [name, values] : numbers_by_column(file)) {
    double greatest = -HUGE_VAL;
    for (const double value : values) greatest = std::fmax(greatest, value);
    all.emplace_back(name, greatest);
  }
  return all;
}

Table read_csv_table(const std::filesystem::path& file, const std::vector<std::string>& columns)
{
  std::istringstream stream(read_input_file(file));
  TableReader reader(file, columns);
  for (std::string line; std::getline(stream, line);) reader.read(line);
  return reader.finished();
}

}  // namespace tamp::tools
