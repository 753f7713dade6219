#pragma once

#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/execute/work.hpp"

namespace tamp::test
{

/// Instances given one by one, some of them another rank's, whose messages a test delivers when it likes.
class ToyWork final : public runtime::Work
{
 public:
  using Body = std::function<void(const runtime::Step&)>;

  int add(int home, std::vector<int> predecessors, Body body)
  {
    instances_.push_back({std::move(predecessors), std::move(body), home});
    return n_instances() - 1;
  }
  int add(std::vector<int> predecessors, Body body) { return add(0, std::move(predecessors), std::move(body)); }
  int add_remote() { return add(-1, {}, {}); }
  /// The message of another rank's instance has come; the next poll finds it. From any thread.
  void deliver(int instance)
  {
    const std::lock_guard lock(mutex_);
    delivered_.push_back(instance);
  }

  int n_instances() const override { return static_cast<int>(instances_.size()); }
  std::span<const int> predecessors(int instance) const override { return at(instance).predecessors; }
  int home(int instance, int n_workers) const override
  {
    return at(instance).home < 0 ? -1 : at(instance).home % n_workers;
  }
  void run(int instance, const runtime::Step& step) override { at(instance).body(step); }
  std::string describe(int instance) const override
  {
    return (at(instance).home < 0 ? "message " : "task ") + std::to_string(instance);
  }
  bool has_messages() const override { return messages; }
  void poll(std::vector<int>& arrived, std::uint64_t idle_since) override
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    ++n_polls;
    n_idle_polls += idle_since != 0;
    if (on_poll) on_poll();
    arrived.insert(arrived.end(), delivered_.begin(), delivered_.end());
    delivered_.clear();
  }
  void fail(const std::string& what) override { failures.push_back(what); }

  bool messages = true;
  int n_polls = 0;
  int n_idle_polls = 0;
  /// Called in every poll; what it throws is what another rank's failure throws.
  std::function<void()> on_poll;
  std::vector<std::string> failures;

 private:
  struct ToyInstance {
    std::vector<int> predecessors;
    Body body;
    int home;
  };

  const ToyInstance& at(int instance) const { return instances_[static_cast<std::size_t>(instance)]; }

  std::vector<ToyInstance> instances_;
  std::mutex mutex_;
  std::vector<int> delivered_;
};

}  // namespace tamp::test
