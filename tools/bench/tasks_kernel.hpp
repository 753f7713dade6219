#pragma once

namespace tamp::tools::bench
{

/// Keeps the multiply-add units of one core busy from registers alone, for a time in proportion to `n_iterations`; a
/// few cycles each. Two siblings of one core take twice as long as two cores, which is what calibration looks for.
double multiply_add_kernel(int n_iterations);

/// Nanoseconds per iteration with the kernel on `n_threads` at once; a median over a millisecond.
double kernel_ns(int n_threads);

}  // namespace tamp::tools::bench
