#pragma once

#include <functional>

#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// Does `work` on this rank and then learns how it went on the others: if it threw on one, it throws on all, so that no
/// rank waits in a collective call for one that has given up. Collective.
///
/// If the first rank that failed threw FileError, all throw FileError; otherwise a rank throws what it has itself, and
/// std::runtime_error where it has nothing.
void on_all_ranks(const Communicator& communicator, const std::function<void()>& work);

/// Does work on the first rank alone; if it throws, all ranks do.
void on_first_rank(const Communicator& communicator, const std::function<void()>& work);

}  // namespace tamp::runtime
