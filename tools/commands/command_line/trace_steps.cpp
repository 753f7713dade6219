#include "tools/commands/command_line/trace_steps.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace tamp::tools
{

namespace
{

/// Digits alone, of a number that fits.
std::optional<std::int64_t> whole_number(std::string_view text)
{
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end || value < 0) return {};
  return value;
}

[[noreturn]] void refuse(const std::string& text, const char* expected)
{
  throw std::invalid_argument(fmt::format("{}; expected {}", text.empty() ? "nothing" : text, expected));
}

}  // namespace

runtime::TraceChoice trace_choice(const std::string& text)
{
  if (text == "none") return runtime::TraceChoice::none();
  if (text == "slowest") return runtime::TraceChoice::slowest();
  if (const auto n = whole_number(text)) return runtime::TraceChoice::first_steps(*n);
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) refuse(text, "a whole number, at least 0, or FIRST:LAST, slowest or none");
  const auto first = whole_number(std::string_view(text).substr(0, colon));
  const auto last = whole_number(std::string_view(text).substr(colon + 1));
  if (!first || !last || *first < 1 || *last < *first) {
    refuse(text, "FIRST:LAST, whole numbers, from step 1 on and not downwards");
  }
  return runtime::TraceChoice::range(*first, *last);
}

CLI::Validator is_trace_choice()
{
  const auto problem = [](const std::string& text) -> std::string {
    try {
      trace_choice(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  return CLI::Validator(problem, "");
}

}  // namespace tamp::tools
