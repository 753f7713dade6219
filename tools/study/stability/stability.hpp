#pragma once

#include "tools/study/study_batch.hpp"

namespace tamp::tools::stability
{

/// Runs the entries of the failure catalogue, inputs/stability, and writes and prints a table of what failed and what
/// survived: `stability.json` and `stability.md`. Throws InputError for a name that is no entry's, and for an entry
/// that does not say what fails and what survives; FileError; Interrupted; and SimulationError, after all is written,
/// if an entry does not fail and survive as told.
void run_catalogue(const study::StudyBatch& batch);

}  // namespace tamp::tools::stability
