#pragma once

#include <string>

namespace tamp::tools
{

/// TAMP's own version, such as "0.2.0".
std::string version();

/// Text of `tamp --version`: version, build type, compiler, and what the program is linked to.
std::string version_text();

}  // namespace tamp::tools
