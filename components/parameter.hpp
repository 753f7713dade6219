#pragma once

#include <string_view>
#include <variant>

#include "components/range.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// A parameter that a scene gives an object: a number, a whole number, a yes or no, or a vector with as many entries as
/// the scene has dimensions. What consists of such values lists them as `parameters()`, from which its keys are read
/// and documented; what one of them says of another is for its `check()`, which throws BadParameter.
template <class Owner>
struct Parameter {
  std::string_view key;
  /// SI, such as "kg/m^3".
  std::string_view unit;
  /// The ends of a whole number's range are finite.
  Range range;
  std::variant<double Owner::*, int Owner::*, bool Owner::*, Vector<3> Owner::*> value;
  /// Half a line for people, in Markdown.
  std::string_view meaning{};
  /// Whether it may be left out; a default-constructed object then gives its value, infinity for none.
  bool optional = false;
};

template <class Object>
constexpr bool has_parameters = requires
{
  Object::parameters();
};

}  // namespace tamp::components
