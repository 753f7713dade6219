#include "tools/run/drive/read_path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>

#include "components/errors.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/tables/csv_table.hpp"

namespace tamp::tools
{

namespace
{

const std::vector<std::string>& deformation_columns()
{
  static const std::vector<std::string> names{"time", "F11", "F12", "F13", "F21", "F22", "F23", "F31", "F32", "F33"};
  return names;
}

/// The prescribed deformation has these after those of F.
constexpr std::size_t angle_column = 10, axis_column = 11, n_prescribed_columns = 14;

bool is_data(const std::string& line)
{
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first != std::string::npos && line[first] != '#';
}

std::vector<std::string> lines_of(const std::filesystem::path& file)
{
  std::istringstream stream(read_input_text(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::optional<double> finite_number(const std::string& word)
{
  std::istringstream stream(word);
  double value = 0;
  // No number out of range, infinity or NaN passes this.
  if (!(stream >> value) || stream.peek() != EOF) return std::nullopt;
  return value;
}

Table prescribed_deformation(const std::filesystem::path& file, const std::vector<std::string>& lines)
{
  Table table{file, std::vector<std::vector<double>>(n_prescribed_columns), {}};
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!is_data(lines[i])) continue;
    const std::string place = fmt::format("{}:{}", file.string(), i + 1);
    std::istringstream line(lines[i]);
    const std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
    if (words.size() != n_prescribed_columns) {
      problems.push_back(
          {place, fmt::format("{} values", words.size()), "expected 14: time, F row by row, angle in degrees, axis"});
      continue;
    }
    for (std::size_t k = 0; k < n_prescribed_columns; ++k) {
      const std::optional<double> value = finite_number(words[k]);
      if (!value) problems.push_back({place, fmt::format("\"{}\"", words[k]), "expected a finite number"});
      table.columns[k].push_back(value.value_or(0));
    }
    table.place_of_row.push_back(place);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return table;
}

Table path_table(const std::filesystem::path& file)
{
  const std::vector<std::string> lines = lines_of(file);
  const auto first = std::find_if(lines.begin(), lines.end(), is_data);
  if (first == lines.end()) throw InputError({file.string(), "an empty path", "expected two or more rows"});
  const bool is_csv = first->find(',') != std::string::npos;
  return is_csv ? read_csv_table(file, deformation_columns()) : prescribed_deformation(file, lines);
}

PathRow path_row(const Table& table, std::size_t i)
{
  const auto& columns = table.columns;
  PathRow row{.time = columns[0][i], .deformation_gradient = {}};
  for (int k = 0; k < 9; ++k) row.deformation_gradient(k / 3, k % 3) = columns[static_cast<std::size_t>(k) + 1][i];
  if (columns.size() == n_prescribed_columns) {
    row.angle = columns[angle_column][i] * std::numbers::pi / 180;
    for (std::size_t k = 0; k < 3; ++k) row.axis[static_cast<int>(k)] = columns[axis_column + k][i];
  }
  return row;
}

}  // namespace

DeformationPath read_path(const std::filesystem::path& file)
{
  const Table table = path_table(file);
  std::vector<PathRow> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i) rows.push_back(path_row(table, i));
  try {
    return DeformationPath(std::move(rows));
  } catch (const components::BadValue& bad) {
    throw InputError(table.problem(bad.row, bad.found, "expected " + bad.expected));
  }
}

}  // namespace tamp::tools
