#include "tools/system/report_failure.hpp"

#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "tools/system/console.hpp"

namespace tamp::tools
{

namespace
{

/// Every line of `text` on stderr, each with the program's name before it.
void print_error(const std::string& text)
{
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    print_err("tamp: {}\n", text.substr(begin, end - begin));
    begin = end + 1;
  }
  std::fflush(stderr);
}

/// Whether it is done within the time in which ranks that fail together all come here.
bool done_soon(MPI_Request& request)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  int done = 0;
  while (done == 0 && std::chrono::steady_clock::now() < end) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return done != 0;
}

}  // namespace

int report_failure(const std::string& text, ExitCode code, const runtime::Communicator& ranks)
{
  if (ranks.size() == 1) {
    print_error(text);
    return static_cast<int>(code);
  }
  // The first rank with something to say, and the exit code that it says it with.
  struct Verdict {
    int order;
    int code;
  };
  const int last = ranks.size();
  const Verdict own{text.empty() ? last : ranks.rank(), static_cast<int>(code)};
  Verdict common{};
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&own, &common, 1, MPI_2INT, MPI_MINLOC, MPI_COMM_WORLD, &request);
  if (done_soon(request)) {
    if (common.order == ranks.rank()) print_error(text);
    return common.code;
  }
  print_error(fmt::format("rank {}: {}", ranks.rank(), text.empty() ? "another rank has failed" : text));
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
  return static_cast<int>(code);
}

}  // namespace tamp::tools
