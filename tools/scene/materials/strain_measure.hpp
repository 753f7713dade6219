#pragma once

#include <string>
#include <vector>

#include "tools/scene/tables/table.hpp"

namespace tamp::tools
{

/// In what volumetric strains the numbers of a material are given, compression positive: -ln J, or 1 - J.
enum class StrainMeasure { logarithmic, engineering };

/// Converts column `i`, of total or plastic strains, into logarithmic ones. Throws InputError, with the place, for
/// strains of 1 and above.
void convert_to_logarithmic(Table& table, std::size_t i, StrainMeasure measure);

}  // namespace tamp::tools
