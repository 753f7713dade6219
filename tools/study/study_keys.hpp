#pragma once

#include "tools/scene/json/keys.hpp"

namespace tamp::tools::study
{

/// The keys of a study file, see docs/how_to/study.md.
const ObjectKeys& study_keys();

}  // namespace tamp::tools::study
