#include "runtime/profile/check_profile.hpp"

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace tamp::runtime
{

namespace
{

/// Upper bounds of the numbers in a profile: thirty thousand years for times [s], and for counts what ten million steps
/// may come to.
constexpr double most_seconds = 1e12, most_counted = 1e24;

void check(double number, double least, double most, const std::string& key)
{
  if (!(number >= least && number <= most)) throw std::out_of_range(key);
}

/// All numbers below a key.
void check_numbers(const nlohmann::json& value, const std::string& key)
{
  if (value.is_number()) {
    const bool is_time = key == "s" || key.ends_with("_s");
    // A gain or an overhead may be a little less than none, and what belongs to no patch has patch -1.
    return check(value.get<double>(), is_time ? 0 : -1, is_time ? most_seconds : most_counted, key);
  }
  for (const auto& [name, member] : value.items()) {
    if (value.is_structured()) check_numbers(member, value.is_object() ? name : key);
  }
}

/// The number of patches or ranks, one more than their largest index; infinite where the profile has no list of them.
double end_of(const nlohmann::json& profile, const char* key)
{
  const auto list = profile.find(key);
  if (list == profile.end() || !list->is_array()) return std::numeric_limits<double>::infinity();
  return static_cast<double>(list->size());
}

void check_place(const nlohmann::json& place, double end, const std::string& key)
{
  if (place.is_number()) check(place.get<double>(), -1, end - 1, key);
}

}  // namespace

void check_profile(const nlohmann::json& profile)
{
  check_numbers(profile, "");
  if (!profile.is_object()) return;
  const auto list = [&](const char* key) { return profile.value(key, nlohmann::json::array()); };
  const double n_patches = end_of(profile, "patches"), n_ranks = end_of(profile, "ranks");
  for (const nlohmann::json& link : list("longest_chain")) {
    check_place(link.value("patch", nlohmann::json()), n_patches, "patch");
    check_place(link.value("rank", nlohmann::json()), n_ranks, "rank");
  }
  for (const nlohmann::json& patch : list("patches")) {
    check_place(patch.value("rank", nlohmann::json()), n_ranks, "rank");
  }
  for (const nlohmann::json& task : list("mean_step")) {
    for (const nlohmann::json& instance : task) {
      check_place(instance.at(0), n_patches, "patch");
      check_place(instance.at(2), n_ranks, "rank");
      for (const std::size_t time : {3U, 4U}) check(instance.at(time).get<double>(), 0, most_seconds, "mean_step");
    }
  }
}

}  // namespace tamp::runtime
