#include "tools/scene/materials/yield_table.hpp"

#include "components/errors.hpp"
#include "components/materials/yield_surface.hpp"
#include "tests/fuzz/readers.hpp"

void tamp::fuzz::yield_table(const std::filesystem::path& file)
{
  const tools::YieldTable yield = tools::read_yield_table(file, tools::YieldMeasure::q, "measure");
  try {
    yield.lifted_by(components::YieldSurface(yield.table.columns[0], yield.table.columns[1], 0.7));
  } catch (const components::BadValue&) {
  }
}
