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

/// What the program answers to a command line.
inline Outcome tamp_with(const std::string& arguments)
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), err = (folder.path() / "err").string();
  const std::string line = std::string(TAMP_PROGRAM) + " " + arguments + " >" + out + " 2>" + err;
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
}

}  // namespace tamp::test
