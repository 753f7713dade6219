#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/study/points.hpp"
#include "tools/study/quantities.hpp"

namespace tamp::tools::study
{

/// Reference that the answers to one quantity are compared with.
struct Reference {
  enum class Kind {
    none,
    exact,
    run,          ///< a single run, taken as it is
    finest,       ///< the finest of several runs
    extrapolated  ///< the limit that several runs tend to
  };
  Kind kind = Kind::none;
  Answer answer;
  /// Scale by which differences are divided to be errors; not where `relative` is false, for an answer of 0.
  double scale = 1;
  bool relative = true;
  /// How far the reference itself may be off, as an error: 1.25 times what is extrapolated, or would be.
  std::optional<double> uncertainty;
  std::optional<double> order;
  /// Whether errors against it are bounds: false where its runs do not converge.
  bool bound = false;
  std::string note;
  /// The point that it is, where it is a run.
  int point = 0;

  /// Error of a point's answer; empty without a reference.
  std::optional<double> error(const Quantity& quantity, const Answer& other) const;
};

/// A point with its result.
struct MeasuredPoint {
  Point point;
  PointResult result;
  bool done() const { return result.end == End::done; }
};

/// A reference whose runs are not all done is none, and its note says why. `method` is empty where all methods have the
/// same.
Reference reference_of(const Study& study, const Quantity& quantity, const std::vector<MeasuredPoint>& points,
                       const std::string& method = "");

/// Spacings of the values of a refined setting: the values, or where they rise their inverses.
std::vector<double> spacings_of(const std::vector<Json>& values);

}  // namespace tamp::tools::study
