#include "tools/system/machine.hpp"

#include <fstream>
#include <string>

#include "tools/system/usable_cores.hpp"

namespace tamp::tools
{

namespace
{

/// Linux's name of the processor; empty where it has none.
std::string processor_name()
{
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "";
}

std::string instruction_set()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") != 0) return "AVX-512";
  if (__builtin_cpu_supports("avx2") != 0) return "AVX2";
  return "SSE2";
#elif defined(__aarch64__)
  return "NEON";
#else
  return "";
#endif
}

}  // namespace

nlohmann::ordered_json machine_json()
{
  return {
      {"processor", processor_name()}, {"instruction_set", instruction_set()}, {"cores", usable_cores().of_machine}};
}

}  // namespace tamp::tools
