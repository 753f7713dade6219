#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tamp::test
{

/// A row of `history.csv`: numbers by the names of their columns.
using HistoryRow = std::map<std::string, double>;

inline std::vector<HistoryRow> history_of(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::string heading, line;
  std::getline(stream, heading);
  std::vector<HistoryRow> rows;
  while (std::getline(stream, line)) {
    std::istringstream names(heading), values(line);
    HistoryRow row;
    for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');) {
      row[name] = std::stod(value);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace tamp::test
