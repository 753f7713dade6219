#pragma once

#include <variant>

#include "components/moduli/engineering_strain.hpp"
#include "components/moduli/modulus_surface.hpp"
#include "components/moduli/network_modulus.hpp"
#include "components/moduli/support_vector_modulus.hpp"
#include "components/moduli/unloading_table.hpp"

namespace tamp::components
{

/// The elastic models that a tabular cap can have; each is an ElasticModel. Tables are converted to logarithmic strain
/// when they are read, fitted models when they are asked.
using Modulus = std::variant<UnloadingTable, SupportVectorModulus, NetworkModulus, ModulusSurface,
                             EngineeringStrain<SupportVectorModulus>, EngineeringStrain<NetworkModulus>>;

}  // namespace tamp::components
