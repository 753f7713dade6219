#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace tamp::tools
{

/// What the program tells its caller; 1 is for what should not happen, and the number of a signal adds to 128.
enum class ExitCode { done = 0, fault = 1, bad_input = 2, bad_simulation = 3, bad_file = 4, signal = 128 };

/// One thing that is wrong with what a person gave the program.
struct Problem {
  /// FILE#/json/pointer, FILE:ROW of a table, or the command line's argument.
  std::string place;
  std::string found;
  /// May be empty where nothing needs to be said.
  std::string expected;
};

/// All that is wrong with an input, at once; `what()` has a line `PLACE: FOUND; EXPECTED` for each.
struct InputError : std::runtime_error {
  explicit InputError(std::vector<Problem> found) : std::runtime_error(lines(found)), problems(std::move(found)) {}
  explicit InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

  std::vector<Problem> problems;

 private:
  static std::string lines(const std::vector<Problem>& problems)
  {
    std::string text;
    for (const Problem& p : problems) {
      if (!text.empty()) text += '\n';
      text += p.place + ": " + p.found + (p.expected.empty() ? "" : "; " + p.expected);
    }
    return text;
  }
};

}  // namespace tamp::tools
