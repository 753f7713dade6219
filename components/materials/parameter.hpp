#pragma once

#include <string_view>

#include "components/range.hpp"

namespace tamp::components
{

/// A number that a scene gives a model. A model that consists of such numbers lists them as `parameters()`, from which
/// scenes are read; what one of them says of another is for its `check()`, which throws BadParameter.
template <class Model>
struct Parameter {
  std::string_view key;
  std::string_view unit;
  Range range;
  double Model::*value;
  /// May be left out; then it is what a default model has.
  bool optional = false;
};

}  // namespace tamp::components
