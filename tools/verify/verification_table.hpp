#pragma once

#include <string>
#include <vector>

#include "tools/scene/document.hpp"

/// What a verification found, as tables for people.
namespace tamp::tools::verify
{

/// In Markdown: for each study its title and what it is about, and for each of its quantities a table with a row for
/// each method. `studies` are their `study.json`.
std::string to_markdown(const std::vector<Json>& studies);

/// What was expected and does not hold, a line each.
std::vector<std::string> failures_of(const Json& study);

}  // namespace tamp::tools::verify
