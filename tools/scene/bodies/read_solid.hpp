#pragma once

#include <optional>
#include <string>

#include "components/geometry/solid.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// Reads the solid that stands at `key` of `holder`, with all solids that it is made of; docs/reference/scene.md lists
/// the types. Where a solid names a "file", that file's JSON comes first, with the other keys merged over it. Empty if
/// there is a problem, which the document then knows.
template <int D>
std::optional<components::Solid<D>> read_solid(JsonReader& holder, const std::string& key);

}  // namespace tamp::tools
