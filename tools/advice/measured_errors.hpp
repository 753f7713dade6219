#pragma once

#include <optional>
#include <string>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// The measured relative error of a method, for one number of cells, or between the numbers of cells that were tried.
struct MeasuredError {
  double least, greatest;
  std::string command;  ///< the command that measures it anew

  /// The error in words, such as "8 %" or "8 to 16 %".
  std::string text() const;
};

/// The error of a scene's method in the test `of` on so many cells, from measured_errors.json; none where nobody has
/// measured it. A row there has the test, the method, cells (of "piston" to a metre, of "flat punch" and "turn of a
/// thin rod" to the half width, of "strip footing" to the width), the error, and the command; a key of the method that
/// a row lacks makes no difference there. All rows have particles that take the scene's defaults in all else.
std::optional<MeasuredError> measured_error(const tasks::Scene& scene, const std::string& of, double cells);

}  // namespace tamp::tools
