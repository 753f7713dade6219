#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "new_scenes.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/shell_word.hpp"

namespace tamp::tools
{

namespace
{

/// A kind of scene, and the geometries in which there is one, the usual one first. The scenes themselves are files of
/// tools/commands/new_scenes.
struct SceneKind {
  std::string name;
  std::vector<std::string> geometries;
};

const std::vector<SceneKind>& scene_kinds()
{
  static const std::vector<SceneKind> kinds{{"ball", {"axisymmetric", "plane", "space"}},
                                            {"punch", {"plane", "axisymmetric", "space"}},
                                            {"cone", {"axisymmetric", "space"}},
                                            {"footing", {"plane", "axisymmetric", "space"}}};
  return kinds;
}

std::vector<std::string> names_of_scene_kinds()
{
  std::vector<std::string> names(scene_kinds().size());
  std::ranges::transform(scene_kinds(), names.begin(), &SceneKind::name);
  return names;
}

struct NewArguments {
  std::string kind;
  std::string out;
  /// Name of the geometry; where empty, the usual one of the kind.
  std::string geometry;
};

/// The geometry that is asked for. Throws InputError where the kind has none such: a cone is round.
std::string geometry_of(const NewArguments& options)
{
  const auto kind = std::ranges::find(scene_kinds(), options.kind, &SceneKind::name);
  if (options.geometry.empty()) return kind->geometries.front();
  if (std::ranges::count(kind->geometries, options.geometry) > 0) return options.geometry;
  throw InputError({"--in", fmt::format("{}, where there is no {}", options.geometry, options.kind),
                    fmt::format("expected {}", fmt::join(kind->geometries, " or "))});
}

/// Refuses a file that exists, even a link that leads nowhere: this command does not replace what somebody has written.
void expect_nothing_at(const std::filesystem::path& file)
{
  std::error_code none;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, none))) return;
  throw InputError({file.string(), "already exists", "expected the name of a new file"});
}

/// Prints the commands to run the scene and to draw its force over depth, and where these figures will be.
void print_next_steps(const std::string& kind, const std::string& geometry, const std::filesystem::path& file)
{
  const std::string scene = shell_word(file.string());
  const std::string run = "runs/" + file.stem().string();
  const char* const up = geometry == "space" ? "z" : "y";
  write_out(without_controls(fmt::format("{0}\n  tamp check {0}\n  tamp run {0}\n", scene)));
  write_out(without_controls(
      fmt::format("  tamp plot {} {}.depth {}.contact_force_{} --out curve.svg\n", shell_word(run), kind, kind, up)));
  write_out(without_controls(fmt::format(
      "The run takes some seconds. {} then has the columns time[s], {}.depth[m] and {}.contact_force_{}[N].\n",
      shell_word(run + "/history.csv"), kind, kind, up)));
}

void write_new_scene(const NewArguments& options)
{
  const std::string geometry = geometry_of(options);
  const std::filesystem::path file = options.out;
  expect_nothing_at(file);
  const std::string name = options.kind + "_" + geometry;
  write_output({"", file}, std::ranges::find(new_scenes, name, &NewScene::name)->text);
  print_next_steps(options.kind, geometry, file);
}

}  // namespace

CLI::App* add_new_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("new", "Write a small scene with comments, to start from; it runs in seconds");
  const auto options = std::make_shared<NewArguments>();
  command->add_option("KIND", options->kind, "what goes into the ground")
      ->required()
      ->check(is_one_of(names_of_scene_kinds()));
  command->add_option("OUT", options->out, "the file to write; it must not exist")
      ->type_name("FILE")
      ->required()
      ->check(is_not_empty());
  command
      ->add_option("--in", options->geometry,
                   "plane, axisymmetric or space; no cone in plane; punch in axisymmetric is a round flat plate that "
                   "falls freely, such as the pad of a lander")
      ->check(is_one_of({"plane", "axisymmetric", "space"}))
      ->default_str("axisymmetric for ball and cone, plane for punch and footing");
  command->footer(
      examples({{"tamp new ball ball.json", "a steel ball that falls into dry sand, axisymmetric"},
                {"tamp new punch punch.json --in space", "a quarter of a square punch, in three dimensions"},
                {"tamp new footing footing.json", "a strip footing on clay, whose load is known"}}));
  command->callback([options] { write_new_scene(*options); });
  return command;
}

}  // namespace tamp::tools
