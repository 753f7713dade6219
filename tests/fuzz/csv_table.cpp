#include "tools/scene/tables/csv_table.hpp"

#include "tests/fuzz/readers.hpp"

void tamp::fuzz::csv_table(const std::filesystem::path& file)
{
  tools::greatest_of_columns(file);
  const std::vector<std::vector<std::string>> headings{{"a[-]", "b[Pa]"}, {"b[Pa]", "c"}};
  tools::read_csv_table(file, headings);
}
