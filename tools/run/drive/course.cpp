#include "tools/run/drive/course.hpp"

#include <fmt/core.h>

namespace tamp::tools
{

tasks::SimulationError Course::error(const std::string& cause, double time, std::size_t row) const
{
  return {fmt::format("{}: at {:.6g} s, on the way to row {} of the path", cause, time, row), material.name, -1, {}};
}

}  // namespace tamp::tools
