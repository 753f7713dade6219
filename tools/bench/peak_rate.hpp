#pragma once

namespace tamp::tools::bench
{

/// Multiplies and adds of doubles per second, as many of one as of the other, in registers as wide as this program
/// uses, none of them fused, on one thread: the best of a few passes, as the bound that it serves for should be.
double multiplies_and_adds_per_second();

}  // namespace tamp::tools::bench
