#include "tools/commands/command_line/command_text.hpp"

#include <algorithm>

#include "tools/commands/command_line/option_words.hpp"
#include "tools/system/shell_word.hpp"

namespace tamp::tools
{

std::string command_text(const CLI::App& command, const std::vector<const CLI::Option*>& without)
{
  std::string text = "tamp " + command.get_name();
  for (const CLI::Option* option : command.get_options({})) {
    if (option->count() == 0 || std::find(without.begin(), without.end(), option) != without.end()) continue;
    const std::string name = option->get_positional() ? "" : " --" + option->get_lnames().front();
    if (is_flag(*option))
      text += name;
    else
      for (const std::string& value : option->results()) text += name + " " + shell_word(value);
  }
  return text;
}

}  // namespace tamp::tools
