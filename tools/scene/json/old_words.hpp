#pragma once

#include <string>
#include <vector>

#include "tools/scene/json/keys.hpp"

namespace tamp::tools
{

/// A key or a word of an earlier version, as it stands in a file or an assignment.
struct OldWord {
  JsonPointer place;      ///< where it was written
  JsonPointer place_now;  ///< where its value is now
  std::string word;
  std::string word_now;
  /// Whether the key of now stands beside it.
  bool is_repeated = false;
};

/// Replaces old keys and words in an object, and in those below it, by those of now. Of a key that is there under both
/// names the later one counts.
std::vector<OldWord> replace_old_words(Json& object, const ObjectKeys& keys);

}  // namespace tamp::tools
