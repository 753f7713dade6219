#pragma once

namespace tamp::components
{

/// Whose change of volume a particle takes in a step, against locking and pressures that alternate between particles:
/// its own, the mean of its cell (cell_average.hpp), or that of its cell's centre (f_bar.hpp).
enum class Relief { none, cell_average, f_bar };

}  // namespace tamp::components
