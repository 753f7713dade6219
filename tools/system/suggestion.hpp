#pragma once

#include <string>
#include <vector>

namespace tamp::tools
{

/// "did you mean WORD?", of the known word that is near; `otherwise` if none is.
std::string meant_or(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise);

}  // namespace tamp::tools
