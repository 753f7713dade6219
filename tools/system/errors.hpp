#pragma once

#include <algorithm>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace tamp::tools
{

/// Exit codes of the program: `no_resources` for files, memory, threads and unforeseen errors; the
/// number of a signal adds to 128.
enum class ExitCode { done = 0, bad_input = 2, bad_simulation = 3, no_resources = 4, signal = 128 };

/// Memory or threads that the system does not give, with what they were for.
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Does the work; what the system refuses on the way is said with `purpose`, such as "laying out the particles".
template <class Work>
auto with_resources_for(const std::string& purpose, const Work& work)
{
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw ResourceError("out of memory, " + purpose);
  } catch (const std::filesystem::filesystem_error&) {
    throw;
  } catch (const std::system_error& error) {
    throw ResourceError(std::string(error.what()) + ", " + purpose);
  }
}

/// A problem with what a person gave the program.
struct Problem {
  /// FILE#/json/pointer, FILE:ROW of a table, or the command line's argument.
  std::string place;
  std::string found;
  /// May be empty where nothing needs to be said.
  std::string expected;
};

/// All that is wrong with an input, at once; `what()` has a line `PLACE: FOUND; EXPECTED` for each of the first fifty.
struct InputError : std::runtime_error {
  explicit InputError(std::vector<Problem> found) : std::runtime_error(lines(found)), problems(std::move(found)) {}
  explicit InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

  std::vector<Problem> problems;

 private:
  static std::string lines(const std::vector<Problem>& problems)
  {
    constexpr std::size_t most = 50;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, problems.size()); ++i) {
      const Problem& p = problems[i];
      if (i > 0) text += '\n';
      text += p.place + ": " + p.found + (p.expected.empty() ? "" : "; " + p.expected);
    }
    if (problems.size() > most) text += "\nand " + std::to_string(problems.size() - most) + " more problems";
    return text;
  }
};

}  // namespace tamp::tools
