#include "runtime/execute/on_workers.hpp"

#include <fmt/core.h>

namespace tamp::runtime
{

namespace
{

/// Instances that wait for nothing.
class Calls : public Work
{
 public:
  Calls(int n, const std::function<void(int)>& work) : n_(n), work_(work) {}

  int n_instances() const override { return n_; }
  std::span<const int> predecessors(int) const override { return {}; }
  int home(int instance, int n_workers) const override { return instance % n_workers; }
  void run(int instance, const Step&) override { work_(instance); }
  std::string describe(int instance) const override { return fmt::format("call {} of {}", instance, n_); }

 private:
  int n_;
  const std::function<void(int)>& work_;
};

}  // namespace

void on_workers(Executor& executor, int n, const std::function<void(int)>& work)
{
  Calls calls(n, work);
  Schedule schedule(calls, executor.n_threads());
  try {
    executor.run(schedule, {});
  } catch (const TaskError& error) {
    std::rethrow_exception(error.cause);
  }
}

}  // namespace tamp::runtime
