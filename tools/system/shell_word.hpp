#pragma once

#include <string>

namespace tamp::tools
{

/// A word of a command line as a shell takes it: in quotes where it has to be.
std::string shell_word(const std::string& word);

}  // namespace tamp::tools
