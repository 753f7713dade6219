#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/study/compare/comparison.hpp"

namespace tamp::tools::compare
{

/// `compare.json`: what was compared on which machine, and for each model its figures and its series over time.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// `compare.csv`: a row for each model with the figures that `compare.json` has under the same names.
std::string to_csv(const Comparison& comparison);

/// The comparison as text for a terminal.
std::string to_text(const Comparison& comparison);

}  // namespace tamp::tools::compare
