#pragma once

#include <string>

#include "tools/scene/document.hpp"

namespace tamp::tools
{

/// JSON as a person would lay it out: indented by two, with lists and objects that hold nothing nested on one line
/// where they fit in it. Ends without a line break.
std::string printed(const Json& value);

}  // namespace tamp::tools
