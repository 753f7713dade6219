#include "tools/scene/materials/unloading_curves.hpp"

#include "components/errors.hpp"
#include "components/moduli/unloading_table.hpp"
#include "tests/fuzz/readers.hpp"
#include "tools/system/errors.hpp"

void tamp::fuzz::unloading_curves(const std::filesystem::path& file)
{
  try {
    tools::read_unloading_curves(file, tools::StrainMeasure::engineering);
  } catch (const tools::InputError&) {
  }
  const tools::Table table = tools::read_unloading_curves(file, tools::StrainMeasure::logarithmic);
  try {
    components::UnloadingTable(table.columns[0], table.columns[1], table.columns[2]);
  } catch (const components::BadValue&) {
  }
}
