#include "runtime/ranks/common_failure.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "runtime/reason.hpp"
#include "runtime/step_error.hpp"

namespace tamp::runtime
{

namespace
{

struct StepFailure {
  /// Empty where there is none.
  std::string text;
  bool is_step_error = false;
};

StepFailure failure_of(const std::exception_ptr& error)
{
  if (error == nullptr) return {};
  try {
    std::rethrow_exception(error);
  } catch (const StepError& step_error) {
    return {step_error.what(), true};
  } catch (const std::exception& other) {
    return {reason(other), false};
  } catch (...) {
    return {"unknown exception", false};
  }
}

}  // namespace

bool is_step_error(const std::exception_ptr& error)
{
  return failure_of(error).is_step_error;
}

void throw_common_failure(const std::exception_ptr& own, long step, const Communicator& communicator)
{
  const StepFailure failure = failure_of(own);
  const std::vector<std::string> texts = communicator.gather(failure.text);
  const std::vector<char> are_step_errors = communicator.gather_value(static_cast<char>(failure.is_step_error));
  const std::vector<long> steps = communicator.gather_value(step);
  const auto first = std::find_if(texts.begin(), texts.end(), [](const std::string& text) { return !text.empty(); });
  if (first == texts.end()) throw std::runtime_error("another rank has failed");
  const bool same_step = std::all_of(steps.begin(), steps.end(), [&](long other) { return other == steps.front(); });
  if (same_step && are_step_errors[static_cast<std::size_t>(first - texts.begin())] != 0) throw StepError(*first);
  throw std::runtime_error(*first);
}

}  // namespace tamp::runtime
