#include "tools/command_line/suggestions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/command_line/option_words.hpp"
#include "tools/errors.hpp"

namespace tamp::tools
{

namespace
{

/// How many letters are changed, left out, added, or swapped with the next (Damerau, Levenshtein).
std::size_t distance(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands)
{
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

/// Null if there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name)
{
  for (const CLI::App* command : commands_of(app)) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

[[noreturn]] void refuse(const std::string& word, const std::string& found, const std::vector<std::string>& known,
                         const std::string& otherwise)
{
  const auto meant = closest(word, known);
  throw InputError({word, found, meant ? "did you mean " + *meant + "?" : otherwise});
}

void expect_known_option(const CLI::App& command, const std::string& word)
{
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options({})) {
    for (const std::string& long_name : option->get_lnames()) known.push_back("--" + long_name);
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  refuse(name, fmt::format("no option of {}", command.get_name()), known,
         fmt::format("see tamp help {}", command.get_name()));
}

/// Whether the word is the value of the option before it.
bool is_value(const CLI::App& command, const std::string& before)
{
  if (!before.starts_with("--") || before.find('=') != std::string::npos) return false;
  const CLI::Option* option = command.get_option_no_throw(before);
  return option != nullptr && !is_flag(*option);
}

}  // namespace

std::optional<std::string> closest(const std::string& word, const std::vector<std::string>& known)
{
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return distance(word, a) < distance(word, b); });
  if (nearest == known.end()) return std::nullopt;
  const std::size_t most = std::max<std::size_t>(1, std::min(word.size(), nearest->size()) / 3);
  if (distance(word, *nearest) > most) return std::nullopt;
  return *nearest;
}

void expect_known_words(const CLI::App& app, const std::vector<std::string>& words)
{
  const auto commands = commands_of(app);
  const std::string all = fmt::format("expected one of {}", fmt::join(names_of(commands), ", "));
  if (words.empty()) throw InputError({"no command", "nothing to do", all});
  if (words.front().starts_with("-")) return expect_known_option(app, words.front());
  const CLI::App* command = find_command(app, words.front());
  if (command == nullptr) refuse(words.front(), "no command of tamp", names_of(commands), all);

  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--") return;
    if (is_value(*command, words[i - 1])) continue;
    if (const CLI::App* below = find_command(*command, words[i])) command = below;
    if (words[i].starts_with("--")) expect_known_option(*command, words[i]);
  }
}

}  // namespace tamp::tools
