#include "tools/scene/materials/strain_measure.hpp"

#include <fmt/core.h>

#include "components/moduli/engineering_strain.hpp"

namespace tamp::tools
{

void convert_to_logarithmic(Table& table, std::size_t i, StrainMeasure measure)
{
  if (measure == StrainMeasure::logarithmic) return;
  std::vector<double>& column = table.columns[i];
  for (std::size_t row = 0; row < column.size(); ++row) {
    if (!(column[row] < 1)) {
      throw InputError(table.problem(static_cast<std::ptrdiff_t>(row), fmt::format("strain {}", column[row]),
                                     "expected engineering strains below 1"));
    }
    column[row] = components::logarithmic_strain(column[row]);
  }
}

}  // namespace tamp::tools
