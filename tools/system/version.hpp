#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tamp::tools
{

/// TAMP's own version, such as "0.2.0".
std::string version();

/// How the program was built: `version`, `commit` (see commit()), `build`, its type, `architecture`, which processors
/// it is for, and `compiler`.
nlohmann::ordered_json build_json();

/// Text of `tamp --version`: version, build type, compiler, and what the program is linked to.
std::string version_text();

}  // namespace tamp::tools
