#pragma once

#include <filesystem>

#include "components/moduli/support_vector_fit.hpp"

namespace tamp::tools
{

/// Reads a support-vector regression of pressure in the JSON layout published with the Vaango code:
/// X_conversion_factor, X_scale, X_min, X_max (two numbers each, of total and plastic volumetric strain),
/// y_conversion_factor, y_scale, y_min, gamma, intercept, support_vectors [[x1, x2], ...] and dual_coeffs [[a_1, ...]].
/// A number may stand alone in a list; keys that are not used are let be. Throws FileError if the file cannot be read,
/// and InputError, with every problem and its JSON pointer.
components::SupportVectorFit read_support_vectors(const std::filesystem::path& file);

}  // namespace tamp::tools
