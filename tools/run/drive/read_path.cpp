#include "tools/run/drive/read_path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>

#include "tools/run/drive/path_columns.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/tables/csv_table.hpp"

namespace tamp::tools
{

namespace
{

/// Columns of the prescribed deformation, after the time.
constexpr std::size_t gradient_column = 1, angle_column = 10, axis_column = 11, n_prescribed_columns = 14;

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

std::vector<PathRow> prescribed_rows(const Table& table)
{
  const auto& columns = table.columns;
  std::vector<PathRow> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    PathRow row{.time = columns[0][i], .deformation_gradient = {}};
    for (std::size_t k = 0; k < 9; ++k) {
      row.deformation_gradient(static_cast<int>(k) / 3, static_cast<int>(k) % 3) = columns[gradient_column + k][i];
    }
    row.angle = columns[angle_column][i] * std::numbers::pi / 180;
    for (std::size_t k = 0; k < 3; ++k) row.axis[static_cast<int>(k)] = columns[axis_column + k][i];
    rows.push_back(row);
  }
  return rows;
}

std::vector<std::string> names_in(const std::string& heading)
{
  std::vector<std::string> names;
  std::istringstream stream(heading);
  for (std::string name; std::getline(stream, name, ',');) {
    const std::size_t first = name.find_first_not_of(" \t\r");
    names.push_back(first == std::string::npos ? "" : name.substr(first, name.find_last_not_of(" \t\r") - first + 1));
  }
  return names;
}

/// The rows of a CSV path; what no column names is 0.
std::vector<MixedRow> csv_rows(const Table& table, const std::vector<std::string>& names,
                               const std::vector<StressControl>& controls)
{
  std::vector<MixedRow> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    MixedRow row{0, Matrix<3>::Zero(), std::vector<double>(controls.size())};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string& name = names[k];
      const double value = table.columns[k][i];
      if (name == "time") row.time = value;
      if (name[0] == 'F') row.deformation_gradient(name[1] - '1', name[2] - '1') = value;
      for (std::size_t c = 0; c < controls.size(); ++c) {
        if (controls[c].name == name) row.stress[c] = value;
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

LoadPath csv_path(Table& table, const std::vector<std::string>& names, const std::vector<StressControl>& controls)
{
  return made_from(table, [&](const Table& read) -> LoadPath {
    std::vector<MixedRow> rows = csv_rows(read, names, controls);
    if (!controls.empty()) return MixedPath(controls, std::move(rows));
    std::vector<PathRow> deformations;
    deformations.reserve(rows.size());
    for (const MixedRow& row : rows) deformations.push_back({row.time, row.deformation_gradient});
    return DeformationPath(std::move(deformations));
  });
}

}  // namespace

LoadPath read_path(const std::filesystem::path& file)
{
  const std::vector<std::string> lines = lines_of(file);
  const auto first = std::find_if(lines.begin(), lines.end(), is_data);
  if (first == lines.end()) throw InputError({file.string(), "an empty path", "expected two or more rows"});
  if (first->find(',') == std::string::npos) {
    Table table = prescribed_deformation(file, lines);
    return made_from(table, [](const Table& read) { return DeformationPath(prescribed_rows(read)); });
  }
  const std::vector<std::string> names = names_in(*first);
  const auto controls = stress_controls(names, fmt::format("{}:{}", file.string(), first - lines.begin() + 1));
  Table table = read_csv_table(file, names);
  return csv_path(table, names, controls);
}

}  // namespace tamp::tools
