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
  /// Half a line for people, in Markdown.
  std::string_view meaning;
  /// Whether it may be left out; a default-constructed model then gives its value.
  bool optional = false;
};

}  // namespace tamp::components
