#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <string_view>

#include "tests/tools/scene/small_scene.hpp"

namespace tamp::test
{

/// A change of a good scene, and what is said of it then: nothing, if it is still good. The change is assignments as
/// --set has them, with spaces between and ' for ". A message that begins with a pointer is one of --set; * stands for
/// any text.
struct BadSceneRow {
  std::string change;
  std::string message;
};

inline std::vector<std::string> assignments_of(std::string change)
{
  std::replace(change.begin(), change.end(), '\'', '"');
  std::vector<std::string> assignments;
  for (std::size_t start = 0, end = 0; end < change.size(); start = end + 1) {
    end = std::min(change.find(" /", start), change.size());
    assignments.push_back(change.substr(start, end - start));
  }
  return assignments;
}

inline bool is_like(std::string_view text, std::string_view pattern)
{
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return text == pattern;
  if (text.substr(0, star) != pattern.substr(0, star)) return false;
  for (std::size_t end = star; end <= text.size(); ++end) {
    if (is_like(text.substr(end), pattern.substr(star + 1))) return true;
  }
  return false;
}

/// Problems of a good scene after some assignments.
using GoodScene = std::function<std::string(const std::vector<std::string>&)>;

inline GoodScene shipped(const std::string& file)
{
  return [file](const std::vector<std::string>& assignments) {
    return problems_of(TemporaryFolder(), TAMP_SOURCE_DIR "/inputs/" + file, assignments);
  };
}

/// Makes each change after those that all rows have in common.
inline void check_rows(const GoodScene& problems_with, const std::string& common, const std::vector<BadSceneRow>& rows)
{
  for (const auto& [change, message] : rows) {
    std::vector<std::string> assignments = assignments_of(common);
    for (std::string& assignment : assignments_of(change)) assignments.push_back(std::move(assignment));

    const std::string found = problems_with(assignments);

    const std::string expected = (message.rfind('/', 0) == 0 ? "--set#" : "") + message;
    INFO("change:   " << change << "\nfound:    " << found << "\nexpected: " << expected);
    CHECK(is_like(found, expected));
  }
}
inline void check_rows(const GoodScene& problems_with, const std::vector<BadSceneRow>& rows)
{
  check_rows(problems_with, "", rows);
}

}  // namespace tamp::test
