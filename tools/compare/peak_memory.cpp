#include "tools/compare/peak_memory.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace tamp::tools::compare
{

namespace
{

/// Runs this program with other arguments, silently, and gives its exit status.
int run_self(std::vector<std::string> arguments)
{
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&silent, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = posix_spawn(&child, "/proc/self/exe", &silent, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&silent);
  int status = 0;
  if (failure != 0 || waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::optional<std::size_t> peak_rss_alone(const std::filesystem::path& scene,
                                          const std::vector<std::string>& assignments, int n_threads, long n_steps,
                                          const std::filesystem::path& scratch)
{
  std::vector<std::string> arguments{"tamp",         "run",
                                     scene.string(), "--quiet",
                                     "--threads",    std::to_string(n_threads),
                                     "--steps",      std::to_string(n_steps),
                                     "--out",        scratch.string()};
  for (const std::string& assignment : assignments) arguments.insert(arguments.end(), {"--set", assignment});
  std::optional<std::size_t> bytes;
  if (run_self(std::move(arguments)) == 0) {
    const auto summary = nlohmann::json::parse(std::ifstream(scratch / "summary.json"), nullptr, false);
    if (!summary.is_discarded()) bytes = summary["peak_rss_bytes"]["max"].get<std::size_t>();
  }
  std::filesystem::remove_all(scratch);
  return bytes;
}

}  // namespace tamp::tools::compare
