#pragma once

#include <optional>
#include <string>

#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// JSON as a person would lay it out: indented by two, with lists and objects that hold nothing nested on one line
/// where they fit in it. Ends without a line break.
std::string printed(const Json& value);

/// JSON for programs, indented by so many blanks or on one line. Bytes that are no UTF-8, which a path may have and
/// JSON may not, become U+FFFD.
std::string json_text(const Json& value, int indent = -1);

/// Null where there is none.
template <class T>
Json or_null(const std::optional<T>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace tamp::tools
