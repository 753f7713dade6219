#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/program.hpp"

namespace tamp::test
{

/// A run of the program, and what it wrote into its summary.
struct Run {
  Outcome outcome;
  nlohmann::json summary;
};

/// Runs a scene, named first in `arguments`, in a folder that is gone afterwards.
inline Run run_with(const std::string& arguments)
{
  const TemporaryFolder folder;
  const auto out = folder.path() / "run";
  Outcome outcome = tamp_with("run " + arguments + " --out " + out.string());
  nlohmann::json summary;
  if (std::filesystem::exists(out / "summary.json")) summary = nlohmann::json::parse(read_text(out / "summary.json"));
  return {outcome, summary};
}

}  // namespace tamp::test
