#include "tools/system/markdown_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tamp::tools
{

std::string markdown_table(const std::vector<std::vector<std::string>>& rows)
{
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  const auto line = [&](const std::vector<std::string>& row) {
    std::string text = "|";
    for (std::size_t k = 0; k < row.size(); ++k) text += fmt::format(" {:<{}} |", row[k], widths[k]);
    return text + "\n";
  };
  std::string text = line(rows.front()) + "|";
  for (const std::size_t width : widths) text += " " + std::string(width, '-') + " |";
  text += "\n";
  for (std::size_t r = 1; r < rows.size(); ++r) text += line(rows[r]);
  return text;
}

}  // namespace tamp::tools
