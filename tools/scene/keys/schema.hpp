#pragma once

#include <string>
#include <vector>

#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// The JSON schema (draft 7, which editors know) of scenes; materials and solids, which may be files of their own, are
/// its definitions "material" and "solid". It holds what is known of a key without the rest of the scene. An object
/// that names another under "file" is a part of one: no key of it is compulsory, and null removes a key.
Json scene_schema();

/// The tables of keys of docs/reference/scene.md, in its order: in Markdown, each ending in a line break.
std::vector<std::string> key_tables();

/// A unit as it is shown to people.
std::string shown_unit(std::string unit);

}  // namespace tamp::tools
