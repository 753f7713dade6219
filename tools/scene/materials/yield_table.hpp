#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "components/materials/yield_surface.hpp"
#include "tools/scene/tables/table.hpp"

namespace tamp::tools
{

/// How a yield table gives strength: q = sqrt(3 J2), which a triaxial test measures, or sqrt(J2).
enum class YieldMeasure { q, sqrt_J2 };

/// Pressures and sqrt(J2) [Pa], compression positive, whichever measure the file has.
struct YieldTable {
  Table table;
  YieldMeasure measure;  ///< of the file

  /// The rows that the surface through them lifts by more than 2 %, a line each, with pressure and both strengths in
  /// the file's measure.
  std::vector<std::string> lifted_by(const components::YieldSurface& surface) const;
};

/// The heading of a table of our own says which measure it has, and `stated` may only repeat it; a published one calls
/// its column SqrtJ2 whatever it holds, and has to be given. Throws InputError for a heading of neither or of both and,
/// with `place_of_measure`, for a measure that is missing or contradicts the heading.
YieldTable read_yield_table(const std::filesystem::path& file, std::optional<YieldMeasure> stated,
                            const std::string& place_of_measure);

}  // namespace tamp::tools
