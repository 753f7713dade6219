#include "runtime/ranks/on_all_ranks.hpp"

#include <exception>
#include <string>

#include "runtime/file_error.hpp"
#include "runtime/reason.hpp"

namespace tamp::runtime
{

namespace
{

/// An exception, as far as it can be sent to another rank.
struct Failure {
  std::exception_ptr own;
  /// Empty unless it is a FileError.
  std::string file;
  std::string cause;
};

Failure failure_of(const std::function<void()>& work)
{
  try {
    work();
  } catch (const FileError& error) {
    return {std::current_exception(), error.file, error.cause};
  } catch (const std::exception& error) {
    return {std::current_exception(), "", reason(error)};
  }
  return {};
}

}  // namespace

void on_all_ranks(const Communicator& communicator, const std::function<void()>& work)
{
  const Failure failure = failure_of(work);
  const int n_ranks = communicator.size();
  const int own_place = failure.own != nullptr ? communicator.rank() : n_ranks;
  const std::size_t first = communicator.min(static_cast<std::uint64_t>(own_place));
  if (first == static_cast<std::size_t>(n_ranks)) return;
  const std::string file = communicator.gather(failure.file)[first];
  const std::string cause = communicator.gather(failure.cause)[first];
  // All throw the kind that the first one threw, so that all ranks go the same way from here.
  if (failure.own && failure.file.empty() == file.empty()) std::rethrow_exception(failure.own);
  if (!file.empty()) throw FileError(file, cause);
  throw std::runtime_error("rank " + std::to_string(first) + ": " + cause);
}

void on_first_rank(const Communicator& communicator, const std::function<void()>& work)
{
  on_all_ranks(communicator, [&] {
    if (communicator.is_first()) work();
  });
}

}  // namespace tamp::runtime
