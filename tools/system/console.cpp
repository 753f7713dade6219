#include "tools/system/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "runtime/file_error.hpp"

namespace tamp::tools
{

namespace
{

void expect_written(bool written)
{
  const int cause = errno;
  if (written) return;
  std::clearerr(stdout);
  if (cause != EPIPE) throw runtime::FileError("standard output", std::strerror(cause));
}

bool is_control(unsigned char c)
{
  return (c < 0x20 && c != '\n') || c == 0x7f;
}

}  // namespace

std::string without_controls(std::string_view text)
{
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (is_control(c)) {
      shown += fmt::format("\\x{:02x}", c);
    } else if (c == 0xc2 && next >= 0x80 && next < 0xa0) {  // control characters of eight bits, in UTF-8
      shown += fmt::format("\\x{:02x}", next);
      ++i;
    } else {
      shown += text[i];
    }
  }
  return shown;
}

void guard_console()
{
  // Then the write fails, and says where.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is taken, which is this one.
    if (fcntl(descriptor, F_GETFD) < 0) open("/dev/null", O_RDWR);
  }
}

void write_out(std::string_view text)
{
  expect_written(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

void flush_out()
{
  expect_written(std::fflush(stdout) == 0);
}

void write_err(std::string_view text)
{
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::clearerr(stderr);
}

void print_notes(const std::vector<std::string>& notes)
{
  for (const std::string& note : notes) print_err("tamp: note: {}\n", note);
}

void print_warnings(const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings) print_err("tamp: warning: {}\n", warning);
}

}  // namespace tamp::tools
