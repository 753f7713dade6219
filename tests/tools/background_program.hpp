#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace tamp::test
{

/// Whether a process is at work: neither gone nor dead and waiting for its parent's notice (Linux).
inline bool is_running(pid_t process)
{
  std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return static_cast<bool>(stream >> number >> name >> state) && state != "Z";
}

/// A program that runs on while the test does, with its output thrown away.
class BackgroundProgram
{
 public:
  BackgroundProgram(const std::string& program, const std::string& arguments)
  {
    std::vector<std::string> words{program};
    std::istringstream stream(arguments);
    for (std::string word; stream >> word;) words.push_back(word);
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::fflush(nullptr);
    id_ = fork();
    if (id_ != 0) return;
    static_cast<void>(std::freopen("/dev/null", "w", stdout));
    static_cast<void>(std::freopen("/dev/null", "w", stderr));
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  ~BackgroundProgram()
  {
    if (id_ > 0) {
      send(SIGKILL);
      waitpid(id_, nullptr, 0);
    }
  }
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  void send(int signal) const { kill(id_, signal); }

  /// Waits for its end; 128 and the signal if one ended it.
  int exit_code()
  {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// The processes that it has started and that still run (Linux).
  std::vector<pid_t> children() const
  {
    const std::string id = std::to_string(id_);
    std::ifstream stream("/proc/" + id + "/task/" + id + "/children");
    std::vector<pid_t> all;
    for (pid_t child = 0; stream >> child;) all.push_back(child);
    return all;
  }

 private:
  pid_t id_ = -1;
};

/// Waits for something that another process does, a minute at most.
template <class Condition>
void wait_until(const Condition& holds)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!holds()) {
    REQUIRE(std::chrono::steady_clock::now() < end);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace tamp::test
