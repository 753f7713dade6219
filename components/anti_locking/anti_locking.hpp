#pragma once

#include <vector>

#include "components/choice.hpp"

namespace tamp::components
{

/// Whose change of volume a particle takes in a step, against locking and pressures that alternate between particles:
/// its own, the mean of its cell (cell_average.hpp), or that of its cell's centre (f_bar.hpp).
enum class AntiLocking { none, cell_average, f_bar };

/// All there are, as changes of volume are shared.
inline std::vector<Word<AntiLocking>> words_of(AntiLocking)
{
  return {{"none", AntiLocking::none, "each particle has its own"},
          {"cell_average", AntiLocking::cell_average, "all particles of a material in a cell take their mean"},
          {"f_bar", AntiLocking::f_bar, "all particles in a cell take that at its centre"}};
}

}  // namespace tamp::components
