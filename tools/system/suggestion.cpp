#include "tools/system/suggestion.hpp"

#include "runtime/graph/near_name.hpp"

namespace tamp::tools
{

std::string meant_or(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise)
{
  const std::string near = runtime::near_name(word, known);
  return near.empty() ? otherwise : "did you mean " + near + "?";
}

}  // namespace tamp::tools
