#include "tools/commands/number_checks.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tamp::tools
{

namespace
{

template <class IsRight>
CLI::Validator number_check(const std::string& expected, const IsRight& is_right)
{
  const auto problem = [expected, is_right](const std::string& text) {
    double value = NAN;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && std::isfinite(value) && is_right(value) ? "" : fmt::format("{}; expected {}", text, expected);
  };
  return CLI::Validator(problem, expected);
}

}  // namespace

CLI::Validator is_at_least(double least)
{
  return number_check(fmt::format("at least {}", least), [least](double value) { return value >= least; });
}

CLI::Validator is_above_zero()
{
  return number_check("above 0", [](double value) { return value > 0; });
}

CLI::Validator is_from_to(double least, double most)
{
  return number_check(fmt::format("{} to {}", least, most),
                      [least, most](double value) { return value >= least && value <= most; });
}

}  // namespace tamp::tools
