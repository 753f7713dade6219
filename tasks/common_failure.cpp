#include "tasks/common_failure.hpp"

#include <algorithm>
#include <string>

#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

namespace
{

struct Failure {
  /// Empty where there is none.
  std::string text;
  bool of_simulation = false;
};

Failure told(const std::exception_ptr& error)
{
  if (error == nullptr) return {};
  try {
    std::rethrow_exception(error);
  } catch (const SimulationError& simulation_error) {
    return {simulation_error.what(), true};
  } catch (const std::exception& other) {
    return {other.what(), false};
  } catch (...) {
    return {"unknown exception", false};
  }
}

}  // namespace

bool is_of_simulation(const std::exception_ptr& error)
{
  return told(error).of_simulation;
}

void throw_common_failure(const std::exception_ptr& own, long step, const runtime::Communicator& communicator)
{
  const Failure failure = told(own);
  const std::vector<std::string> texts = communicator.gather(failure.text);
  const std::vector<char> of_simulation = communicator.gather_value(static_cast<char>(failure.of_simulation));
  const std::vector<long> steps = communicator.gather_value(step);
  const auto first = std::find_if(texts.begin(), texts.end(), [](const std::string& text) { return !text.empty(); });
  if (first == texts.end()) throw std::runtime_error("another rank has failed");
  const bool same_step = std::all_of(steps.begin(), steps.end(), [&](long other) { return other == steps.front(); });
  if (same_step && of_simulation[static_cast<std::size_t>(first - texts.begin())] != 0) {
    throw SimulationError(*first, "", -1, {});
  }
  throw std::runtime_error(*first);
}

}  // namespace tamp::tasks
