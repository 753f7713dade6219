#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/system/charts.hpp"
#include "tools/system/console.hpp"

namespace tamp::tools
{

namespace
{

struct PlotArguments {
  std::vector<std::string> words;  ///< folders of runs, then two columns
  std::string measured;
  std::string out;
};

/// The name of a column as part of a file's name: without its unit.
std::string name_in_file(std::string column)
{
  column.erase(std::min(column.find('['), column.size()));
  std::replace(column.begin(), column.end(), '/', '_');
  return column;
}

std::string usual_out(const std::string& x, const std::string& y)
{
  return name_in_file(y) + "-over-" + name_in_file(x) + ".svg";
}

void draw_plot(const PlotArguments& options)
{
  const std::vector<std::string>& words = options.words;
  constexpr std::size_t fewest = 3;
  if (words.size() < fewest) throw CLI::RequiredError("RUN... X Y");
  const std::string out = options.out.empty() ? usual_out(*(words.end() - 2), words.back()) : options.out;
  std::vector<std::string> call{"plot", "--out=" + out};
  if (!options.measured.empty()) call.push_back("--measured=" + options.measured);
  call.emplace_back("--");  // a name may begin with a dash
  call.insert(call.end(), words.begin(), words.end());
  draw_from_inputs(call, out);
  print_out("written to {}\n", out);
}

}  // namespace

CLI::App* add_plot_command(CLI::App& app)
{
  CLI::App* command =
      app.add_subcommand("plot", "Plot one column against another, for one or more runs, with measurements");
  const auto options = std::make_shared<PlotArguments>();
  command
      ->add_option("RUN", options->words,
                   "folders of runs, then the columns across and upwards: those of history.csv or machine.csv, whose "
                   "units in brackets may be left out")
      ->option_text("RUN... X Y")
      ->required();
  command
      ->add_option("--measured", options->measured,
                   "draw the first two columns of this file too, or those that have the names, as points; its heading "
                   "has units, such as depth[mm],force[kN]")
      ->type_name("CSV")
      ->check(is_not_empty());
  command->add_option("--out", options->out, "the picture, .svg or .png; by default Y-over-X.svg")
      ->type_name("FILE")
      ->check(is_not_empty());
  command->footer(
      examples({{"tamp plot runs/ball ball.depth ball.contact_force_y --out curve.svg", "force over depth"},
                {"tamp plot runs/loose runs/dense ball.depth ball.contact_force_y --measured test.csv --out curve.png",
                 "of two runs, beside a test whose file begins with depth[mm],force[kN]"},
                {"tamp plot runs/ball time sand.p_max", "sand.p_max-over-time.svg"},
                {"tamp plot runs/ball time wall", "when the run took its wall-clock time"}}));
  command->callback([options] { draw_plot(*options); });
  return command;
}

}  // namespace tamp::tools
