#include "tools/scene/tables/csv_table.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "tools/scene/files/input_file.hpp"

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
  TableReader(const std::filesystem::path& file, const std::vector<std::vector<std::string>>& headings)
      : headings_(headings)
  {
    table_.file = file;
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

  std::pair<Table, std::size_t> finished()
  {
    if (place_in_line_.empty()) {
      add("no line with the names of the columns", expected_headings());
    } else if (problems_.empty() && table_.n_rows() == 0) {
      add("a table without rows", "expected numbers");
    }
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return {std::move(table_), heading_};
  }

 private:
  void add(const std::string& found, const std::string& expected)
  {
    constexpr std::size_t most = 1000;
    problems_.push_back({place(), found, expected});
    if (problems_.size() == most) throw InputError(std::move(problems_));
  }

  std::string place() const { return fmt::format("{}:{}", table_.file.string(), line_); }

  std::string expected_headings() const
  {
    std::vector<std::string> all;
    for (const std::vector<std::string>& heading : headings_) all.push_back(fmt::format("{}", fmt::join(heading, ",")));
    return fmt::format("expected {}", fmt::join(all, " or "));
  }

  void read_header(const std::vector<std::string_view>& names)
  {
    const auto are_named = [&](const std::vector<std::string>& heading) {
      return std::is_permutation(heading.begin(), heading.end(), names.begin(), names.end());
    };
    const auto found = std::find_if(headings_.begin(), headings_.end(), are_named);
    if (found == headings_.end()) {
      add(fmt::format("columns {}", fmt::join(names, ",")), expected_headings());
      throw InputError(std::move(problems_));
    }
    heading_ = static_cast<std::size_t>(found - headings_.begin());
    for (const std::string& name : *found) {
      const auto at = std::find(names.begin(), names.end(), name);
      place_in_line_.push_back(static_cast<std::size_t>(at - names.begin()));
    }
    table_.columns.resize(names.size());
  }

  void read_row(const std::vector<std::string_view>& parts)
  {
    const std::vector<std::string>& wanted = headings_[heading_];
    if (parts.size() != wanted.size()) {
      add(fmt::format("{} values", parts.size()), fmt::format("expected {}", wanted.size()));
      return;
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::string_view text = parts[place_in_line_[i]];
      const std::optional<double> value = finite_number(text);
      if (!value) add(fmt::format("\"{}\" for {}", text, wanted[i]), "expected a finite number");
      table_.columns[i].push_back(value.value_or(0));
    }
    table_.place_of_row.push_back(place());
  }

  /// Any one of them is wanted.
  const std::vector<std::vector<std::string>>& headings_;
  std::size_t heading_ = 0;
  Table table_;
  /// Where in a line each wanted column stands; empty before the header.
  std::vector<std::size_t> place_in_line_;
  std::vector<Problem> problems_;
  int line_ = 0;
};

/// Calls `use_row` with the number and the parts of each line that is not empty and no comment.
template <class UseRow>
void for_each_row(const std::filesystem::path& file, const UseRow& use_row)
{
  std::istringstream stream(read_input_text(file));
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string_view content = trimmed(line);
    if (!content.empty() && content.front() != '#') use_row(number, split(content));
  }
}

}  // namespace

std::vector<std::pair<std::string, std::vector<double>>> numbers_by_column(const std::filesystem::path& file)
{
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  for_each_row(file, [&](int line, const std::vector<std::string_view>& parts) {
    if (columns.empty()) {
      for (const std::string_view name : parts) columns.emplace_back(name, std::vector<double>{});
      return;
    }
    if (parts.size() != columns.size()) {
      throw InputError({fmt::format("{}:{}", file.string(), line), fmt::format("{} values", parts.size()),
                        fmt::format("expected {}", columns.size())});
    }
    for (std::size_t i = 0; i < parts.size(); ++i) columns[i].second.push_back(finite_number(parts[i]).value_or(NAN));
  });
  return columns;
}

std::vector<std::pair<std::string, double>> greatest_of_columns(const std::filesystem::path& file)
{
  std::vector<std::pair<std::string, double>> all;
  bool is_heading = true;
  for_each_row(file, [&](int, const std::vector<std::string_view>& parts) {
    for (std::size_t i = 0; is_heading && i < parts.size(); ++i) all.emplace_back(parts[i], -HUGE_VAL);
    for (std::size_t i = 0; !is_heading && i < std::min(parts.size(), all.size()); ++i) {
      all[i].second = std::fmax(all[i].second, finite_number(parts[i]).value_or(NAN));
    }
    is_heading = false;
  });
  return all;
}

std::pair<Table, std::size_t> read_csv_table(const std::filesystem::path& file,
                                             const std::vector<std::vector<std::string>>& headings)
{
  std::istringstream stream(read_input_text(file));
  TableReader reader(file, headings);
  for (std::string line; std::getline(stream, line);) reader.read(line);
  return reader.finished();
}

Table read_csv_table(const std::filesystem::path& file, const std::vector<std::string>& columns)
{
  return read_csv_table(file, std::vector<std::vector<std::string>>{columns}).first;
}

}  // namespace tamp::tools
