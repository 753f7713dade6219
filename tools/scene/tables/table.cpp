#include "tools/scene/tables/table.hpp"

#include "tools/scene/files/file_kind.hpp"
#include "tools/scene/tables/csv_table.hpp"
#include "tools/scene/tables/published_table.hpp"

namespace tamp::tools
{

Problem Table::problem(std::ptrdiff_t row, const std::string& found, const std::string& expected) const
{
  const bool in_table = row >= 0 && row < static_cast<std::ptrdiff_t>(n_rows());
  return {in_table ? place_of_row[static_cast<std::size_t>(row)] : file.string(), found, expected};
}

Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns)
{
  if (file_kind(file) == FileKind::json) return read_published_curve(file, columns);
  return read_csv_table(file, columns);
}

}  // namespace tamp::tools
