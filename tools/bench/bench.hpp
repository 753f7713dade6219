#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// Benchmarks, each of which measures what it compares in one run, interleaved, so that a noisy machine disturbs both
/// sides alike.
namespace tamp::tools::bench
{

/// The result as it goes into the file of `--json`, and the table for a person.
struct Result {
  nlohmann::ordered_json json;
  std::string text;
};

/// The punch's first 200 steps: time per particle and step on one thread and on two, against the time that the memory
/// needs at least, and what recording costs.
Result punch(const std::filesystem::path& scene);

/// Time for p and K of one state, in a batch of 4096 spread over the data: Table, SVR, MLP, and SVR and MLP compiled,
/// each against its definition evaluated plainly. The plain network gives K alone.
Result moduli(const std::filesystem::path& material);

}  // namespace tamp::tools::bench
