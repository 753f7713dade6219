#include "tools/scene/tables/published_table.hpp"

#include "tests/fuzz/readers.hpp"

void tamp::fuzz::published_table(const std::filesystem::path& file)
{
  const tools::PublishedTable table = tools::read_published_table(file);
  table.names();
  tools::read_published_curve(file, {"plastic_volumetric[-]", "pressure[Pa]"});
}
