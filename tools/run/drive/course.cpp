#include "tools/run/drive/course.hpp"

#include <fmt/core.h>

namespace tamp::tools
{

tasks::SimulationError Course::error(const std::string& cause, double time, std::size_t row) const
{
  const std::string place = !is_test   ? fmt::format("on the way to row {} of the path", row)
                            : row == 1 ? "on the way to the stress at the start"
                                       : fmt::format("in stage {} of the test", row - 1);
  return {fmt::format("{}: at {:.6g} s, {}", cause, time, place), material.name, -1, {}};
}

}  // namespace tamp::tools
