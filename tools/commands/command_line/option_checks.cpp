#include "tools/commands/command_line/option_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "tools/system/suggestion.hpp"

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

/// Nothing for what is none, or does not fit.
std::optional<std::int64_t> signed_whole_number(const std::string& text)
{
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && at == end ? std::optional(value) : std::nullopt;
}

}  // namespace

CLI::Validator is_whole_from(std::int64_t least)
{
  const std::string expected = fmt::format("a whole number, at least {}", least);
  const auto problem = [expected, least](const std::string& text) {
    const std::optional<std::int64_t> value = signed_whole_number(text);
    return value && *value >= least ? "" : fmt::format("{}; expected {}", text, expected);
  };
  return CLI::Validator(problem, expected);
}

CLI::Validator is_whole_from_to(std::int64_t least, std::int64_t most)
{
  const std::string range = fmt::format("{} to {}", least, most);
  const auto problem = [range, least, most](const std::string& text) {
    const std::optional<std::int64_t> value = signed_whole_number(text);
    if (value && *value >= least && *value <= most) return std::string();
    const bool is_within = is_from_to(static_cast<double>(least), static_cast<double>(most))(text).empty();
    return fmt::format("{}; expected {}{}", text, is_within ? "a whole number, " : "", range);
  };
  return CLI::Validator(problem, range);
}

CLI::Validator is_above_zero()
{
  return number_check("above 0", [](double value) { return value > 0; });
}

CLI::Validator is_at_least_zero()
{
  return number_check("at least 0", [](double value) { return value >= 0; });
}

CLI::Validator is_from_to(double least, double most)
{
  return number_check(fmt::format("{} to {}", least, most),
                      [least, most](double value) { return value >= least && value <= most; });
}

CLI::Validator is_one_of(const std::vector<std::string>& choices)
{
  const auto problem = [choices](const std::string& text) -> std::string {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return "";
    return fmt::format("{}; {}", text, meant_or(text, choices, fmt::format("expected {}", fmt::join(choices, " or "))));
  };
  return CLI::Validator(problem, fmt::format("{{{}}}", fmt::join(choices, ",")));
}

CLI::Validator is_not_empty()
{
  return CLI::Validator([](const std::string& text) { return text.empty() ? "nothing; expected a name" : ""; }, "");
}

}  // namespace tamp::tools
