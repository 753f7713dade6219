#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tamp::tools
{

/// To be called before anything is opened: a closed stdin, stdout or stderr becomes /dev/null, so that no file gets its
/// number; and a reader that goes away, or a file that reaches its limit, no longer ends the program by a signal.
void guard_console();

/// Writes on stdout. Nobody has to listen: to a pipe that is closed nothing is written. Throws FileError if stdout is
/// full.
void write_out(std::string_view text);
void flush_out();

/// Writes on stderr at once. What cannot be written there is lost.
void write_err(std::string_view text);

/// A text that leaves a terminal as it is: control characters but the ends of lines are written out, such as \x1b.
/// Names of files and keys may hold any.
std::string without_controls(std::string_view text);

/// Writes notes on stderr, a line each.
void print_notes(const std::vector<std::string>& notes);
/// The same of what is allowed and hardly ever meant.
void print_warnings(const std::vector<std::string>& warnings);

template <class... Args>
void print_out(fmt::format_string<Args...> format, Args&&... args)
{
  write_out(fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void print_err(fmt::format_string<Args...> format, Args&&... args)
{
  write_err(without_controls(fmt::format(format, std::forward<Args>(args)...)));
}

}  // namespace tamp::tools
