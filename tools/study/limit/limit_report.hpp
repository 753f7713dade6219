#pragma once

#include <string>
#include <vector>

#include "tools/study/limit/limit_search.hpp"
#include "tools/study/study.hpp"

namespace tamp::tools::study
{

struct LimitResults {
  const Study& study;
  std::string command;
  std::string pointer;
  LimitSearch search;
  std::vector<Limit> limits;
};

/// The content of limit.json: each method with all its runs.
Json to_json(const LimitResults& results);
/// The results as CSV, a row for each method.
std::string to_csv(const LimitResults& results);
/// The same for people.
std::string to_text(const LimitResults& results);

}  // namespace tamp::tools::study
