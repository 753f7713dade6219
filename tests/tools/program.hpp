#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/tools/temporary_folder.hpp"

namespace tamp::test
{

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

/// Exit code and output of a command line.
inline Outcome outcome_of(const std::string& command)
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), err = (folder.path() / "err").string();
  const int status = std::system((command + " >" + out + " 2>" + err).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
}

/// Runs the program with a command line.
inline Outcome tamp_with(const std::string& arguments)
{
  return outcome_of(std::string(TAMP_PROGRAM) + " " + arguments);
}

/// Has the program draw no pages, which take more time than small studies, for tests that look at none.
inline void draw_no_pages()
{
  setenv("TAMP_PYTHON", "true", 1);
}

inline void draw_pages()
{
  unsetenv("TAMP_PYTHON");
}

/// Tells Open MPI to take more ranks than cores, to leave them unbound, and to run for root, as in a container.
inline void allow_ranks_anywhere()
{
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
}

/// Runs it on several ranks; one rank runs without a launcher.
inline Outcome tamp_on_ranks(int n_ranks, const std::string& arguments)
{
  allow_ranks_anywhere();
  if (n_ranks == 1) return tamp_with(arguments);
  return outcome_of(std::string(TAMP_MPIEXEC) + " -n " + std::to_string(n_ranks) + " " + TAMP_PROGRAM + " " +
                    arguments);
}

}  // namespace tamp::test
