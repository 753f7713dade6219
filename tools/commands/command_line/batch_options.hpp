#pragma once

#include <CLI/CLI.hpp>

#include "tools/study/study_batch.hpp"

namespace tamp::tools
{

/// The options of commands that run shipped studies. `holds` is what the batch's folder gets, and `list` what the file
/// of `--json`.
void add_batch_options(CLI::App& command, study::StudyBatch& batch, const std::string& holds, const std::string& list);

}  // namespace tamp::tools
