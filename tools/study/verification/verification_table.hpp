#pragma once

#include <string>
#include <vector>

#include "tools/scene/json/document.hpp"

/// Results of a verification, as tables for people.
namespace tamp::tools::verify
{

/// In Markdown: for each study its title and what it is about, and for each of its quantities a table with a row for
/// each method. `studies` are their `study.json`.
std::string to_markdown(const std::vector<Json>& studies);

/// For each quantity of a study and each method `{problem, quantity, method, order, expected_order, errors, passed}`:
/// errors from the coarsest to the finest, null where a point came to none; orders null where none was found or
/// expected; `passed` null where nothing was expected.
Json to_list(const std::vector<Json>& studies);

/// Expectations that are to hold and do not, a line each.
std::vector<std::string> failures_of(const Json& study);

/// Expectations that are missed as known, with the reason; and those listed as missed that hold.
std::vector<std::string> known_misses_of(const Json& study);
std::vector<std::string> held_misses_of(const Json& study);

}  // namespace tamp::tools::verify
