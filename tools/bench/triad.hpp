#pragma once

namespace tamp::tools::bench
{

/// Bytes per second of a[i] = b[i] + s c[i] on one thread, 24 bytes an element as STREAM counts them, over arrays far
/// larger than a core's own caches; the best of a few passes, as the bound that it serves for should be.
double triad_bytes_per_second();

}  // namespace tamp::tools::bench
