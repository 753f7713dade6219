#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/program.hpp"

namespace test_command_line
{

using namespace tamp::test;
namespace fs = std::filesystem;

namespace
{

const std::vector<std::string> all_commands{"new",       "run",   "check",   "schema",  "graph",      "profile",
                                            "plot",      "drive", "compare", "modulus", "study",      "verify",
                                            "stability", "bench", "help",    "version", "completion", "man"};

/// Words that bash offers for a line of which the last word is being typed.
std::string bash_offers(const std::string& line)
{
  const TemporaryFolder folder;
  const auto script = folder.write("ask.bash", "source <(" TAMP_PROGRAM
                                               " completion bash)\n"
                                               "COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _tamp\n"
                                               "echo \"${COMPREPLY[@]}\"\n");
  return outcome_of("cd " TAMP_SOURCE_DIR " && bash " + script.string() + " " + line).out;
}

}  // namespace

TEST_CASE("a word that is not known is reported before what is missing, with what was meant")
{
  const std::vector<std::array<std::string, 2>> all{
      {"rnu", "rnu: no command of tamp; did you mean run?"},
      {"help rnu", "rnu: no command of tamp; did you mean run?"},
      {"--vresion", "--vresion: no option of tamp; did you mean --version?"},
      {"run --hlep", "--hlep: no option of run; did you mean --help?"},
      {"run a.json --quite", "--quite: no option of run; did you mean --quiet?"},
      {"run a.json --quiet --froce", "--froce: no option of run; did you mean --force?"},
      {"run --stepps=3", "--stepps: no option of run; did you mean --steps?"},
      {"verify --shrot", "--shrot: no option of verify; did you mean --short?"},
      {"check --something-else", "--something-else: no option of check; see tamp help check"},
      {"run", "SCENE is required; see tamp help run"},
      {"graph a.json --format jsn", "--format: jsn; did you mean json?"},
      {"completion csh", "SHELL: csh; did you mean zsh?"},
      {"completion powershell", "SHELL: powershell; expected bash or zsh"},
      {"verify bra", "bra: no study of inputs/verification; did you mean bar?"},
      {"stability nul_space", "nul_space: no study of inputs/stability; did you mean null_space?"},
      {"compare " TAMP_SOURCE_DIR "/inputs/punch/quick.json --models tabel",
       "--models: \"tabel\"; did you mean table?"}};
  for (const auto& [arguments, said] : all) {
    INFO(arguments);
    const Outcome outcome = tamp_with(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "tamp: " + said + "\n");
  }
  CHECK_THAT(tamp_with("").err, Catch::Contains("no command") && Catch::Contains("run, check, schema"));
}

TEST_CASE("help and version are commands, and the same as the options")
{
  CHECK(tamp_with("help").out == tamp_with("--help").out);
  CHECK(tamp_with("help run").out == tamp_with("run --help").out);
  CHECK(tamp_with("help verify").out == tamp_with("verify --help").out);
  CHECK(tamp_with("version").out == tamp_with("--version").out);
}

TEST_CASE("the help of every command fits on a screen and has examples, of files that there are")
{
  for (const std::string& command : all_commands) {
    INFO(command);
    const Outcome outcome = tamp_with("help " + command);
    REQUIRE(outcome.exit_code == 0);
    const std::size_t begin = outcome.out.find("\nExamples:\n");
    REQUIRE(begin != std::string::npos);
    std::istringstream help(outcome.out.substr(0, begin)), shown(outcome.out.substr(begin));
    for (std::string line; std::getline(help, line);) CHECK(line.size() <= 80);
    int n_examples = 0;
    for (std::string word; shown >> word;) {
      if (word == "tamp") ++n_examples;
      if (word.starts_with("inputs/")) CHECK(fs::exists(fs::path(TAMP_SOURCE_DIR) / word));
    }
    CHECK(n_examples > 0);
  }
}

TEST_CASE("bash completes commands, options, values and files")
{
  CHECK(bash_offers("tamp ru") == "run\n");
  CHECK(bash_offers("tamp veri") == "verify\n");
  CHECK(bash_offers("tamp verify --sh") == "--short\n");
  CHECK(bash_offers("tamp run a.json --checkpoint-k") == "--checkpoint-keep\n");
  CHECK(bash_offers("tamp graph a.json --format ''") == "dot json html svg\n");
  CHECK(bash_offers("tamp run READ") == "README.md\n");
  CHECK_THAT(bash_offers("tamp ''"), Catch::Contains("run") && !Catch::Contains("README.md"));
}

TEST_CASE("the manual page has every command and every option, and roff has nothing to say of it")
{
  const TemporaryFolder folder;
  const Outcome page = tamp_with("man");
  REQUIRE(page.exit_code == 0);
  for (const std::string& command : all_commands) CHECK_THAT(page.out, Catch::Contains(".SS tamp " + command + "\n"));
  CHECK_THAT(page.out, Catch::Contains("\\fB\\-\\-checkpoint\\-keep\\fR \\fIN\\fR"));
  if (outcome_of("command -v groff").exit_code != 0) return;

  const Outcome drawn = outcome_of("groff -man -Tascii -ww " + folder.write("tamp.1", page.out).string());

  CHECK(drawn.exit_code == 0);
  CHECK(drawn.err.empty());
}

TEST_CASE("a run that is stopped says the command that goes on, and that one does")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "a run").string();
  const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json --quiet --threads 1 --steps 60 ";

  const Outcome stopped =
      tamp_with("run " + scene + "--wall-limit 1e-3 --set '/title=it'\\''s short' --out '" + out + "'");

  REQUIRE(stopped.exit_code == 143);
  const std::size_t at = stopped.err.find("to go on: tamp ");
  REQUIRE(at != std::string::npos);
  std::string again = stopped.err.substr(at + std::string("to go on: tamp ").size());
  again.pop_back();
  CHECK_THAT(again, Catch::EndsWith("--restart '" + out + "'") && !Catch::Contains("--out"));
  // As it stands, its limit stops it again at once.
  const std::string limit = " --wall-limit 1e-3";
  REQUIRE(again.find(limit) != std::string::npos);
  const Outcome went_on = tamp_with(again.replace(again.find(limit), limit.size(), ""));
  CHECK(went_on.exit_code == 0);
  CHECK(nlohmann::json::parse(read_text(fs::path(out) / "summary.json"))["steps"] == 60);
}

TEST_CASE("a run that fails says how to go on from its last checkpoint")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();

  const Outcome failed = tamp_with("run " TAMP_SOURCE_DIR
                                   "/inputs/punch/quick.json --quiet --threads 1 --steps 300 --checkpoint-steps 10 "
                                   "--set /limits/energy_error=1e-4 --out " +
                                   out);

  REQUIRE(failed.exit_code == 3);
  CHECK_THAT(failed.err, Catch::Contains("\ntamp: to go on from step ") && Catch::Contains("--restart " + out));
}

}  // namespace test_command_line
