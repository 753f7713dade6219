#pragma once

#include <variant>

#include "components/materials/bolton_sand.hpp"
#include "components/materials/drucker_prager.hpp"
#include "components/materials/hypoelastic.hpp"
#include "components/materials/mohr_coulomb.hpp"
#include "components/materials/neo_hookean.hpp"
#include "components/materials/neo_hookean_log.hpp"
#include "components/materials/tabular_cap.hpp"

namespace tamp::components
{

/// All the models there are; one more is added here.
using MaterialModel =
    std::variant<Hypoelastic, NeoHookean, NeoHookeanLog, DruckerPrager, MohrCoulomb, BoltonSand, TabularCap>;

}  // namespace tamp::components
