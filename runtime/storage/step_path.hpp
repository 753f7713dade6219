#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace tamp::runtime
{

/// Where the output of a step stands in a field file.
inline std::string step_path(std::int64_t step)
{
  return fmt::format("/step_{:08}", step);
}

/// How an XDMF file names a dataset of `group` in the step at `path`.
inline std::string dataset_in_xdmf(const std::filesystem::path& file, const std::string& path, const std::string& group,
                                   const std::string& name)
{
  return fmt::format("{}:{}/{}/{}", file.filename().string(), path, group, name);
}

}  // namespace tamp::runtime
