#pragma once

#include <variant>

#include "components/moduli/unloading_table.hpp"

namespace tamp::components
{

/// The elastic models that a tabular cap can have; each is an ElasticModel.
using Modulus = std::variant<UnloadingTable>;

}  // namespace tamp::components
