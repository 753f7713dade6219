#pragma once

#include <nlohmann/json.hpp>

namespace tamp::tools
{

/// The machine of this program: `processor`, its name; `instruction_set`, the widest vectors that it offers; `cores`
/// that may be used.
nlohmann::ordered_json machine_json();

}  // namespace tamp::tools
