#pragma once

#include "tools/study/reading/study_reader.hpp"

/// The parts of a study's file, in the order in which they are read: each into the reader's study, with all that is
/// wrong noted. What names methods, quantities or the reference comes after them.
namespace tamp::tools::study
{

void read_measure(StudyReader& in);
void read_methods(StudyReader& in);
/// Reads the points that methods list besides their sweeps.
void read_points(StudyReader& in);
void read_quantities(StudyReader& in);
void read_reference(StudyReader& in);
void read_budget(StudyReader& in);
void read_expectations(StudyReader& in);
void read_stability(StudyReader& in);
void read_stable_if(StudyReader& in);
void read_map(StudyReader& in);

/// Checks, once all is read, that each quantity has an answer, and that points are not too many.
void expect_answers(StudyReader& in);
void expect_few_points(StudyReader& in);

}  // namespace tamp::tools::study
