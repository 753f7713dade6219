#include "tools/scene/yield_table.hpp"

#include "components/errors.hpp"
#include "components/materials/yield_surface.hpp"
#include "tests/fuzz/readers.hpp"

void tamp::fuzz::yield_table(const std::filesystem::path& file)
{
  const tools::Table table = tools::read_yield_table(file, tools::YieldMeasure::q, "measure");
  try {
    components::YieldSurface(table.columns[0], table.columns[1], 0.7);
  } catch (const components::BadValue&) {
  }
}
