#pragma once

#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// The words of a resolved scene that were chosen among others, in the order of its keys: a list of
/// { "key": the pointer, "word": ..., "about": what the key is for, "meaning": that of the word, both in
/// Markdown; either may be empty }.
Json chosen_words(const Json& resolved);

}  // namespace tamp::tools
