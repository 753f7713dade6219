#include "runtime/ranks/together.hpp"

#include <exception>
#include <string>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

namespace
{

/// An exception, as far as it can be told to another rank.
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
    return {std::current_exception(), "", error.what()};
  }
  return {};
}

}  // namespace

void together(const Communicator& communicator, const std::function<void()>& work)
{
  const Failure failure = failure_of(work);
  const std::vector<char> failed = communicator.gather_value(static_cast<char>(failure.own != nullptr));
  std::size_t first = 0;
  while (first < failed.size() && failed[first] == 0) ++first;
  if (first == failed.size()) return;
  const std::string file = communicator.gather(failure.file)[first];
  const std::string cause = communicator.gather(failure.cause)[first];
  // Of the kind that the first one threw, so that all ranks go the same way from here.
  if (failure.own && failure.file.empty() == file.empty()) std::rethrow_exception(failure.own);
  if (!file.empty()) throw FileError(file, cause);
  throw std::runtime_error("rank " + std::to_string(first) + ": " + cause);
}

void by_first(const Communicator& communicator, const std::function<void()>& work)
{
  together(communicator, [&] {
    if (communicator.is_first()) work();
  });
}

}  // namespace tamp::runtime
