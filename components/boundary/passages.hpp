#pragma once

#include <string_view>

#include "components/boundary/face.hpp"

/// Faces that are no walls.
namespace tamp::components
{

struct OpenFace {
  static constexpr std::string_view word = "open", meaning = "what crosses leaves the simulation";
  static constexpr FaceTraits traits() { return {.beyond = Beyond::away}; }
  friend bool operator==(const OpenFace&, const OpenFace&) = default;
};

struct PeriodicFace {
  static constexpr std::string_view
      word = "periodic",
      meaning = "on both faces of an axis or on neither, what leaves at one enters at the other, see below";
  static constexpr FaceTraits traits() { return {.beyond = Beyond::opposite}; }
  friend bool operator==(const PeriodicFace&, const PeriodicFace&) = default;
};

}  // namespace tamp::components
