#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// A manufactured solution that goes through a plastic update: a column along x in uniaxial strain, held at x = 0 and
/// free at x = L, that is compacted by S at the first and not at all at the other, and is then at rest,
///
///     u = -S s / 2 (x + L / pi sin(pi x / L)),    F_xx = 1 - S s (1 + cos(pi x / L)) / 2,
///     s = tau - sin(2 pi tau) / (2 pi),           tau = min(t / T, 1).
///
/// No point is ever unloaded, so that all take one path of stress, sigma_xx as a function of e = ln F_xx alone, which
/// is tabulated from the material's own update in small increments. In uniaxial strain P_xx is sigma_xx, and what keeps
/// up the motion is
///
///     b = d^2u/dt^2 - dsigma_xx/de (d^2u/dx^2 / F_xx) / density.
struct CompactedColumn {
  static constexpr std::string_view type = "compacted_column";
  static constexpr std::string_view meaning =
      "a column of any material from x = 0 to `length`, between smooth walls along it and at x = 0, its other end "
      "free, "
      "that is compacted within `duration`, in uniaxial strain: at x = 0 by `compaction`, which is a part of its "
      "length, at `length` not at all. A body force that is found from the material's own stress keeps that up";
  static constexpr std::array<Parameter<CompactedColumn>, 3> parameters();

  double length;      ///< L [m]
  double compaction;  ///< S
  double duration;    ///< T [s]

  /// Throws BadValue where the material finds no stress for such a compaction.
  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<CompactedColumn>, 3> CompactedColumn::parameters()
{
  return {{{"length", "m", above_zero, &CompactedColumn::length},
           {"compaction",
            "",
            {.lower = 0, .upper = 1, .holds_lower = false, .holds_upper = false},
            &CompactedColumn::compaction},
           {"duration", "s", above_zero, &CompactedColumn::duration}}};
}

}  // namespace tamp::components
