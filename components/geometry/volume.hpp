#pragma once

namespace tamp::components
{

/// Volume of a solid [m^3]; of a region of the plane its area [m^2]. `error` is 0 where `value` is a closed form, and
/// else an estimate of how far off it is.
struct Volume {
  double value;
  double error = 0;

  bool is_exact() const { return error == 0; }
};

}  // namespace tamp::components
