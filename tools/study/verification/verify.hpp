#pragma once

#include "tools/study/study_batch.hpp"

namespace tamp::tools::verify
{

/// Runs the studies of inputs/verification, and writes and prints a table of what came out beside what was expected:
/// `verification.json` and `verification.md`, and a list of problems and methods, with orders and errors. Throws
/// InputError for a name that is no study's; FileError; Interrupted; and SimulationError, after all is written, if an
/// expectation does not hold that no study lists as missed. One that is listed and holds is reported.
void verify(const study::StudyBatch& options);

}  // namespace tamp::tools::verify
