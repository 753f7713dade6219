#pragma once

#include <string_view>
#include <variant>

#include "components/range.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// What a scene gives a problem: a number, a whole number, a yes or no, or a vector with as many entries as the scene
/// has dimensions. A problem lists them as `parameters()`, from which scenes are read; what one of them says of another
/// is for its `functions()`.
template <class Problem>
struct ProblemParameter {
  std::string_view key;
  std::string_view unit;
  Range range;
  std::variant<double Problem::*, int Problem::*, bool Problem::*, Vector<3> Problem::*> value;
  /// Whether it may be left out; a default-constructed problem then gives its value.
  bool optional = false;
};

}  // namespace tamp::components
