#pragma once

#include <vector>

#include "components/choice.hpp"

namespace tamp::components
{

/// Whose change of volume a particle takes in a step, against locking and pressures that alternate between particles:
/// its own, the mean of its cell (cell_average.hpp), or that of its cell's centre (f_bar.hpp).
enum class Relief { none, cell_average, f_bar };

/// All there are, as changes of volume are shared.
inline std::vector<Word<Relief>> words_of(Relief)
{
  return {{"none", Relief::none, "each particle has its own"},
          {"cell_average", Relief::cell_average, "all particles of a material in a cell take their mean"},
          {"f_bar", Relief::f_bar, "all particles in a cell take that at its centre"}};
}

}  // namespace tamp::components
