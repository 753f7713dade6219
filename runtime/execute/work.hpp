#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/graph/declaration.hpp"

namespace tamp::runtime
{

/// Work for an executor: instances, numbered in a legal serial order, each after those it depends on.
class Work
{
 public:
  virtual ~Work() = default;

  virtual int n_instances() const = 0;
  /// Instances that must be done before this one, all of lower number.
  virtual std::span<const int> predecessors(int instance) const = 0;
  /// The worker that runs it unless another is idle; -1 for what another rank runs.
  virtual int home(int instance, int n_workers) const = 0;
  /// Called by one worker at a time for one instance, by several for several.
  virtual void run(int instance, const Step& step) = 0;
  /// "task 'contact' on patch 3": for messages about a failure or a stall.
  virtual std::string describe(int instance) const = 0;

  /// Whether other ranks take part. Workers then call `poll`: the idle ones all the time, the busy ones now and then.
  virtual bool has_messages() const { return false; }
  /// Lets messages come and go, and appends to `arrived` the instances of other ranks whose message has come: each once
  /// a step, though a rank that is ahead may send that of its next step. From several workers at once, one does the
  /// work and the others return. `idle_since` is the tick at which the caller ran out of work, 0 if it has not.
  virtual void poll(std::vector<int>& arrived, std::uint64_t idle_since)
  {
    static_cast<void>(arrived);
    static_cast<void>(idle_since);
  }
  /// Tells the other ranks that an instance has failed here; their `poll` throws then.
  virtual void fail(const std::string& what) { static_cast<void>(what); }
};

}  // namespace tamp::runtime
