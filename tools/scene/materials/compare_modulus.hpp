#pragma once

#include <optional>

#include "components/curves/piecewise_linear.hpp"
#include "components/moduli/modulus.hpp"
#include "tools/scene/json/json_reader.hpp"
#include "tools/scene/materials/strain_measure.hpp"

namespace tamp::tools
{

/// The pressures in a material's tables, by their logarithmic strains, compression positive.
struct LoadingCurves {
  std::optional<components::PiecewiseLinear> hydrostat;    ///< pressure of total strain
  std::optional<components::PiecewiseLinear> crush_curve;  ///< as tabulated: X of plastic strain
};

/// Compares the pressures of a material's modulus, if that is a fit, with those of the tables beside it: the unloading
/// curves that "modulus" names and does not use, or else the states of loading, of which the crush curve has the
/// plastic strain and the hydrostat the total. Of each curve the median over its points counts, as fits are far off at
/// the smallest pressures. Where one is off by more than 3 times, that is a warning of the document, with the likely
/// cause; from 1.3 times on, one of its remarks. Tables that cannot be read are a remark.
void compare_with_tables(JsonReader& material, const components::Modulus& modulus, StrainMeasure measure,
                         const LoadingCurves& loading);

}  // namespace tamp::tools
