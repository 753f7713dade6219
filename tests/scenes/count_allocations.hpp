#pragma once

// Says whether the C library is glibc.
#include <cstdlib>

namespace tamp::test
{

/// Whether this program counts calls of the allocator: it does with glibc and without sanitizers, which have allocators
/// of their own.
#if defined(__GLIBC__) && !TAMP_SANITIZED
inline constexpr bool counts_allocations = true;
#else
inline constexpr bool counts_allocations = false;
#endif

/// Blocks of memory that all threads of this program, and all libraries in it, have asked for so far.
long n_allocations();

}  // namespace tamp::test
