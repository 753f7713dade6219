#pragma once

#include <span>
#include <vector>

namespace tamp::runtime
{

/// Cuts a row of patches into at most `n_ranks` stretches so that the costliest is as cheap as it can be, and gives
/// each stretch to a rank. `order` is the row, `costs` (not negative) go by patch; so does the answer.
std::vector<int> deal_patches(std::span<const int> order, std::span<const double> costs, int n_ranks);

/// The cost of the costliest rank over the mean of all; 1 is perfect, and what no cost at all gets.
double imbalance(std::span<const double> costs, std::span<const int> ranks, int n_ranks);

}  // namespace tamp::runtime
