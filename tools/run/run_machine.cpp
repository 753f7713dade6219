#include "tools/run/run_machine.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "tools/system/machine.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools
{

namespace
{

std::string host_name()
{
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

nlohmann::ordered_json run_machine(int n_ranks, int n_threads)
{
  nlohmann::ordered_json machine{{"host", host_name()}};
  machine.update(machine_json());
  machine.update({{"ranks", n_ranks}, {"threads", n_threads}});
  machine.update(build_json());
  return machine;
}

bool is_this_machine(const nlohmann::json& run_machine)
{
  const nlohmann::json own = tools::run_machine(1, 1);
  return std::ranges::all_of(std::array{"host", "processor", "instruction_set"}, [&](const char* key) {
    const auto value = run_machine.find(key);
    return value != run_machine.end() && *value == own.at(key);
  });
}

}  // namespace tamp::tools
