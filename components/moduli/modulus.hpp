#pragma once

#include <variant>

#include "components/alternatives.hpp"
#include "components/moduli/engineering_strain.hpp"
#include "components/moduli/modulus_surface.hpp"
#include "components/moduli/network_modulus.hpp"
#include "components/moduli/support_vector_modulus.hpp"
#include "components/moduli/unloading_table.hpp"

namespace tamp::components
{

/// The elastic models that a tabular cap can have; each is an ElasticModel. One more is added here. Those that a scene
/// can name have
///
///  - `type`, the name in scenes, and `meaning`, what the model is, for people;
///  - either `parameters()`, the numbers that it consists of (parameter.hpp), or `file`, what its file is, for people;
///    tools/scene/materials/read_modulus.cpp then reads it;
///  - `compile_tolerance`, to which `tamp compare` compiles it, see ModulusSurface.
///
/// Tables are converted to logarithmic strain when they are read; a model that was fitted to strains stands here as an
/// EngineeringStrain too, which converts them when it is asked.
using Modulus = std::variant<UnloadingTable, SupportVectorModulus, NetworkModulus, ModulusSurface,
                             EngineeringStrain<SupportVectorModulus>, EngineeringStrain<NetworkModulus>>;

/// Calls `visit(std::type_identity<Model>())` for each model that a scene can name.
template <class Visit>
void for_each_named_modulus(Visit&& visit)
{
  for_each_alternative<Modulus>([&]<class Model>(std::type_identity<Model> model) {
    if constexpr (requires { Model::type; }) visit(model);
  });
}

}  // namespace tamp::components
