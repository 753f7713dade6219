#pragma once

#include <cstddef>

namespace tamp::tools::bench
{

/// Bytes per second of a[i] = b[i] + s c[i] on one thread, 24 bytes an element as STREAM counts them, over arrays far
/// larger than a core's own caches; the best of a few passes, as the bound that it serves for should be.
double triad_bytes_per_second(std::size_t n = std::size_t{1} << 24);

/// Bytes per second of the same on each of `n_threads` threads while all run at once, measured in about a tenth of a
/// second; 0 where the system does not have the memory or the threads for it.
double triad_bytes_per_second_each(int n_threads);

}  // namespace tamp::tools::bench
