#pragma once

#include <algorithm>
#include <cmath>

#include "components/materials/tabular_cap.hpp"

namespace tamp::components
{

/// How far the update of a particle has come: first in one step, then in as many as its error estimate asks for.
struct CapProgress {
  double done = 0;  ///< share of the strain increment that is done
  double size = 1;  ///< share of it that is tried next
  bool cut = false;
};

enum class Verdict { again, go_on, end };

/// Chooses substeps whose errors stay within their share of the tolerance.
class CapSubsteps
{
 public:
  CapSubsteps(double tolerance, int most) : tolerance_(tolerance), least_size_((1 + 1e-6) / most) {}

  double tolerance() const { return tolerance_; }

  /// Whether the step that was tried with this error counts, and what to try next.
  Verdict judge(CapProgress& progress, double error, UpdateCounts& counts) const
  {
    if (!progress.cut && error <= tolerance_) {
      ++counts.substeps;
      return Verdict::end;
    }
    return judge_cut(progress, error, counts);
  }

 private:
  [[gnu::noinline]] Verdict judge_cut(CapProgress& progress, double error, UpdateCounts& counts) const
  {
    const double size = progress.size, rest = 1 - progress.done;
    const bool accurate = error <= tolerance_ * size, returned = std::isfinite(error);
    if (!progress.cut) {
      ++counts.split_updates;
      progress.cut = true;
      progress.size = even(rest, next_size(size, error, returned));
      return Verdict::again;
    }
    // An even cut may come out longer than the least size by what the cut forgives.
    const bool least = size <= least_size_ * (1 + 1e-8), last = size == rest;
    const double next = next_size(size, error, returned);
    if (!accurate && !least) {
      progress.size = even(rest, next);
      return Verdict::again;
    }
    ++counts.substeps;
    counts.limited_substeps += !accurate;
    progress.done += size;
    if (!returned || last || !(progress.done < 1)) return Verdict::end;
    progress.size = even(1 - progress.done, next);
    return Verdict::go_on;
  }

  /// The remainder is cut evenly.
  static double even(double rest, double size) { return rest / std::ceil(rest / size - 1e-9); }

  /// The size that the error of the last try allows: the error goes as the cube of the size, its share of the tolerance
  /// as the size.
  double next_size(double size, double error, bool returned) const
  {
    const double room = tolerance_ * size / std::max(error, 1e-4 * tolerance_ * size);
    const double factor = returned ? std::clamp(0.9 * std::sqrt(room), 0.1, 4.0) : 0.25;
    return std::max(size * factor, least_size_);
  }

  double tolerance_, least_size_;
};

}  // namespace tamp::components
