#include "tools/system/capacity.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

namespace tamp::tools
{

namespace
{

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The first number of a file; none where there is no such file, or it says "max".
double number_in(const std::string& file)
{
  double number = 0;
  return std::ifstream(file) >> number ? number : unlimited;
}

double free_on_machine()
{
  std::ifstream stream("/proc/meminfo");
  std::string word;
  double kibibytes = 0;
  while (stream >> word) {
    if (word == "MemAvailable:" && stream >> kibibytes) return 1024 * kibibytes;
  }
  return unlimited;
}

/// The part of a control group's memory that caches files, and can be given up.
double reclaimable(const std::string& folder)
{
  double bytes = 0, number = 0;
  std::ifstream stream(folder + "/memory.stat");
  for (std::string key; stream >> key >> number;) {
    if (key.ends_with("active_file") && !(key.starts_with("total_"))) bytes += number;
  }
  return bytes;
}

/// Memory left by control groups, version 1 or 2; a group is limited by those above it too.
double left_by_control_group()
{
  double left = unlimited;
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':'), second = line.find(':', colon + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(colon + 1, second - colon - 1);
    const bool unified = controllers.empty();
    if (!unified && controllers.find("memory") == std::string::npos) continue;
    const std::string root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    for (std::string group = line.substr(second + 1);; group.erase(group.rfind('/'))) {
      const std::string folder = root + group;
      const double limit = number_in(folder + (unified ? "/memory.max" : "/memory.limit_in_bytes"));
      const double used = number_in(folder + (unified ? "/memory.current" : "/memory.usage_in_bytes"));
      if (limit < unlimited && used < unlimited) left = std::min(left, limit - used + reclaimable(folder));
      if (group.empty() || group == "/") break;
    }
  }
  return left;
}

double left_by_limit(int resource, double used)
{
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return unlimited;
  }
  return static_cast<double>(limit.rlim_cur) - used;
}

/// Number `which` of /proc/self/statm [bytes].
double own_pages(int which)
{
  std::ifstream stream("/proc/self/statm");
  double pages = 0;
  for (int i = 0; i <= which; ++i) stream >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

FreeMemory free_memory(int n_ranks)
{
  const double address_space = left_by_limit(RLIMIT_AS, own_pages(0)), data = left_by_limit(RLIMIT_DATA, own_pages(5));
  FreeMemory least{free_on_machine(), "this machine has free"};
  for (const FreeMemory& room :
       {FreeMemory{left_by_control_group(), "its control group leaves"},
        FreeMemory{n_ranks * address_space, "the limit of the address space (ulimit -v) leaves"},
        FreeMemory{n_ranks * data, "the limit of data (ulimit -d) leaves"}}) {
    if (room.bytes < least.bytes) least = room;
  }
  least.bytes = std::max(least.bytes, 1.0);
  return least;
}

double resident_bytes()
{
  return own_pages(1);
}

double free_disk(const std::filesystem::path& folder)
{
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error);
  while (there.has_relative_path() && !std::filesystem::exists(there, error)) there = there.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(there, error);
  return error ? unlimited : static_cast<double>(space.available);
}

std::string in_bytes(double bytes)
{
  constexpr std::array units{"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024 && unit + 1 < units.size(); ++unit) bytes /= 1024;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

void give_back_freed_memory()
{
#ifdef __GLIBC__
  constexpr int large = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, large);
#endif
}

}  // namespace tamp::tools
