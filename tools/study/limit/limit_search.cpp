#include "tools/study/limit/limit_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp::tools::study
{

namespace
{

using Verdict = Probe::Verdict;

/// Commands that remake a run are to be read by people.
double rounded(double value)
{
  return std::stod(fmt::format("{:.6g}", value));
}

class Bisection
{
 public:
  Bisection(Limit limit, const LimitSearch& search, const std::function<Probe(double)>& try_value)
      : limit_(std::move(limit)), search_(search), try_value_(try_value)
  {
  }

  Limit find()
  {
    add(limit_.written);
    if (search_.between) {
      add(search_.between->first);
      add(search_.between->second);
    } else {
      widen();
    }
    while (has_runs_left() && is_wide() && add(middle())) {
    }
    if (!limit_.edge) limit_.note = why_not();
    return std::move(limit_);
  }

 private:
  /// Whether it had an answer.
  bool add(double value)
  {
    const auto is_known = [=](const Probe& probe) { return probe.value == value; };
    if (std::any_of(limit_.probes.begin(), limit_.probes.end(), is_known)) return true;
    limit_.probes.push_back(try_value_(value));
    limit_.edge = nearest_edge();
    return limit_.probes.back().verdict != Verdict::no_answer;
  }

  bool has_runs_left() const { return static_cast<int>(limit_.probes.size()) < search_.most_runs; }

  /// Away from the value as written until something changes.
  void widen()
  {
    const double factor = limit_.probes.front().verdict == Verdict::stable ? 2 : 0.5;
    while (has_runs_left() && !limit_.edge && add(rounded(limit_.probes.back().value * factor))) {
    }
  }

  double middle() const { return rounded(std::sqrt(limit_.edge->stable.value * limit_.edge->unstable.value)); }

  bool is_wide() const
  {
    if (!limit_.edge) return false;
    const auto [low, high] = std::minmax(limit_.edge->stable.value, limit_.edge->unstable.value);
    return high > low * (1 + search_.within) && middle() != low && middle() != high;
  }

  /// A method may be stable again further on; what counts is where it first is not.
  std::optional<Edge> nearest_edge() const
  {
    std::vector<Probe> all = limit_.probes;
    std::erase_if(all, [](const Probe& probe) { return probe.verdict == Verdict::no_answer; });
    std::sort(all.begin(), all.end(), [](const Probe& a, const Probe& b) { return a.value < b.value; });
    std::optional<Edge> nearest;
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const bool rises = all[i - 1].verdict == Verdict::stable;
      if (rises == (all[i].verdict == Verdict::stable)) continue;
      const double apart = std::abs(std::log(all[i].value * all[i - 1].value) / 2 - std::log(limit_.written));
      if (apart >= least) continue;
      least = apart;
      nearest = rises ? Edge{all[i - 1], all[i]} : Edge{all[i], all[i - 1]};
    }
    return nearest;
  }

  std::string why_not() const
  {
    const auto [least, greatest] = std::minmax_element(
        limit_.probes.begin(), limit_.probes.end(), [](const Probe& a, const Probe& b) { return a.value < b.value; });
    const Probe& last = limit_.probes.back();
    const std::string verdict = to_text(limit_.probes.front().verdict);
    if (last.verdict == Verdict::no_answer) {
      return fmt::format("{}; {} has no answer: {}", verdict, last.value, last.why);
    }
    return fmt::format("{} at all {} values from {} to {}", verdict, limit_.probes.size(), least->value,
                       greatest->value);
  }

  Limit limit_;
  const LimitSearch& search_;
  const std::function<Probe(double)>& try_value_;
};

}  // namespace

std::string to_text(Verdict verdict)
{
  static constexpr std::array<const char*, 3> words{"stable", "unstable", "no answer"};
  return words.at(static_cast<std::size_t>(verdict));
}

Limit search_limit(const std::string& method, double written, const LimitSearch& search,
                   const std::function<Probe(double)>& try_value)
{
  return Bisection({method, written}, search, try_value).find();
}

}  // namespace tamp::tools::study
