#include "tools/bench/bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "runtime/ranks/communicator.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/shipped_inputs.hpp"

namespace tamp::tools
{

namespace
{

struct BenchArguments {
  std::vector<std::string> names;
  std::string json;
  bench::TaskOptions tasks;
  bench::WindowOptions windows;
  bench::PeerOptions peers;
  bench::GainOptions gains;
  /// Numbers of threads; where empty, each benchmark has its own.
  std::vector<int> n_threads;
  /// Options, and the benchmarks that use them.
  std::vector<std::pair<const CLI::Option*, std::vector<std::string>>> uses{};
};

/// Measures a scene that comes with TAMP, unless another was given.
bench::Result windows_of(const std::string& name, const char* shipped, bench::WindowOptions options)
{
  if (options.scene.empty()) options.scene = shipped_input(shipped);
  return bench::windows(name, options);
}

bench::Result gains_of(const BenchArguments& given)
{
  bench::GainOptions options = given.gains;
  if (!given.n_threads.empty()) options.n_threads = given.n_threads.front();
  options.scene = given.windows.scene.empty() ? shipped_input("punch/quick.json") : given.windows.scene;
  return bench::gains(options);
}

bench::Result tasks_of(const BenchArguments& given)
{
  bench::TaskOptions options = given.tasks;
  if (!given.n_threads.empty()) options.n_threads = given.n_threads;
  return bench::tasks(options);
}

using Benchmark = std::function<bench::Result(const BenchArguments&)>;

const std::map<std::string, Benchmark>& benchmarks()
{
  static const std::map<std::string, Benchmark> all{
      {"gains", gains_of},
      {"moduli", [](const BenchArguments&) { return bench::moduli(shipped_input("materials/concrete-sand")); }},
      {"peers", [](const BenchArguments& options) { return bench::peers(options.peers); }},
      {"projectile",
       [](const BenchArguments& options) { return windows_of("projectile", "uxo/quick.json", options.windows); }},
      {"punch", [](const BenchArguments& options) { return windows_of("punch", "punch/quick.json", options.windows); }},
      {"tasks", tasks_of}};
  return all;
}

/// The benchmarks that were asked for, or all that there are for so many ranks.
std::vector<std::string> names_of(const BenchArguments& options, int n_ranks)
{
  if (n_ranks > 1) {
    for (const std::string& name : options.names) {
      if (name != "tasks") throw InputError({name, "started on several ranks", "expected one, or the benchmark tasks"});
    }
    return {"tasks"};
  }
  if (!options.names.empty()) return options.names;
  std::vector<std::string> names;
  for (const auto& [name, benchmark] : benchmarks()) names.push_back(name);
  return names;
}

/// Refuses options that none of these benchmarks uses, and values that one of them cannot do.
void expect_used(const BenchArguments& options, const std::vector<std::string>& names)
{
  const auto is_run = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
  for (const auto& [option, benchmarks] : options.uses) {
    if (option->count() == 0 || std::ranges::any_of(benchmarks, is_run)) continue;
    throw InputError({option->get_name(), fmt::format("not of {}", fmt::join(names, ", ")),
                      fmt::format("expected it with {}", fmt::join(benchmarks, " or "))});
  }
  if (options.n_threads.size() > 1 && is_run("gains")) {
    throw InputError({"--threads", fmt::format("{} of gains", fmt::join(options.n_threads, ",")),
                      "expected one number, or several with the benchmark tasks alone"});
  }
}

void run_benchmarks(const BenchArguments& options)
{
  const auto ranks = runtime::Communicator::world();
  const std::vector<std::string> names = names_of(options, ranks.size());
  expect_used(options, names);
  note_shipped_inputs();
  if (!options.windows.scene.empty()) read_scene(options.windows.scene, {});
  if (ranks.is_first()) expect_outputs({{"--json", options.json}});
  nlohmann::ordered_json json;
  for (const std::string& name : names) {
    const bench::Result result = benchmarks().at(name)(options);
    if (ranks.is_first()) print_out("{}", result.text);
    json[name] = result.json;
  }
  if (ranks.is_first() && !options.json.empty()) write_output({"--json", options.json}, json_text(json, 2) + "\n");
}

/// Refuses a number of bytes that does not hold whole values.
std::string multiple_of_8(const std::string& bytes)
{
  return std::stoi(bytes) % 8 == 0 ? "" : bytes + " is no multiple of 8";
}

}  // namespace

CLI::App* add_bench_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("bench", "Measure TAMP on this machine");
  const auto options = std::make_shared<BenchArguments>();
  std::vector<std::string> known;
  for (const auto& [name, benchmark] : benchmarks()) known.push_back(name);
  command->add_option("NAME", options->names, "which benchmarks; all without a name")->check(is_one_of(known));
  command->add_option("--json", options->json, "write the results to this file too")->type_name("FILE");
  const auto is_of = [&](CLI::Option* option, const std::vector<std::string>& benchmarks) {
    options->uses.emplace_back(option, benchmarks);
    return option;
  };
  is_of(command->add_option_function<int>(
            "--rounds",
            [options](int n) {
              options->tasks.n_rounds = options->windows.n_rounds = options->peers.n_rounds = options->gains.n_rounds =
                  n;
            },
            "of tasks (15, as far as a minute allows), gains (15), windows of punch and projectile (5) and peers (5): "
            "how often each is measured"),
        {"tasks", "gains", "punch", "projectile", "peers"})
      ->check(is_whole_from(1));
  is_of(command->add_option(
            "--scene", options->windows.scene,
            "of punch, projectile and gains: run this scene instead of inputs/punch/quick.json, which takes a minute, "
            "or inputs/uxo/quick.json, which takes five"),
        {"punch", "projectile", "gains"})
      ->check(CLI::ExistingFile);
  is_of(command->add_option_function<int>(
            "--steps",
            [options](int n) { options->windows.n_steps = options->gains.n_steps = options->peers.n_steps = n; },
            "of punch and projectile: steps of a window, instead of a twentieth of the run, or two seconds if that is "
            "less; of peers and gains: steps of a round, instead of 50 and 400"),
        {"punch", "projectile", "peers", "gains"})
      ->check(is_whole_from(1));
  is_of(command->add_option("--particles", options->peers.n_particles,
                            "of peers: about how many, instead of 40,000 in the plane and 64,000 in space"),
        {"peers"})
      ->check(is_whole_from_to(64, 100'000'000));
  is_of(command->add_option(
            "--task", options->gains.tasks,
            "of gains: slow this task down, instead of the costliest on the longest chain and the costliest beside it"),
        {"gains"})
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check(is_not_empty());
  is_of(command->add_option("--threads", options->n_threads,
                            "of tasks: numbers of threads, as in 1,2; of gains: how many, instead of 2"),
        {"tasks", "gains"})
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(is_whole_from_to(1, 1024));
  is_of(command->add_option("--message-bytes", options->tasks.message_bytes,
                            "of tasks on several ranks: data that one sends to the next in a step, a multiple of 8"),
        {"tasks"})
      ->check(is_whole_from_to(8, 1 << 20))
      ->check(CLI::Validator(multiple_of_8, ""));
  command->footer(examples({{"tamp bench gains", "whether what a profile says of faster tasks comes true"},
                            {"tamp bench moduli", "Table, SVR and MLP by evaluation"},
                            {"tamp bench peers", "TAMP beside a plain MLS-MPM"},
                            {"tamp bench punch --json punch.json", "windows of the quick punch"}}));
  command->callback([options] { run_benchmarks(*options); });
  return command;
}

}  // namespace tamp::tools
