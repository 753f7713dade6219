#pragma once

#include <array>

#include "components/materials/state_columns.hpp"

namespace tamp::components
{

/// The state that a particle of soil keeps from step to step where moduli and strength are formulas.
template <class Number>
struct SoilStateOf {
  Number plastic_volumetric = 0;  ///< compression positive: dilation makes it fall
  Number equivalent_plastic = 0;  ///< sum of sqrt(2/3 de:de), e the plastic strain's deviator
};
using SoilState = SoilStateOf<double>;

template <class Model>
inline constexpr std::array<StateColumn<Model>, 2> soil_columns{{
    {"plastic_volumetric", "-",
     [](const Model&, const SoilState& s, const Invariants&) { return s.plastic_volumetric; }},
    {"equivalent_plastic", "-",
     [](const Model&, const SoilState& s, const Invariants&) { return s.equivalent_plastic; }},
}};

/// Extremes of these columns.
inline constexpr std::array<StateExtreme, 3> soil_extremes{
    {{.column = 0}, {.column = 0, .greatest = false}, {.column = 1}}};

}  // namespace tamp::components
