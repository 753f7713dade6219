#pragma once

#include <filesystem>

namespace tamp::tools
{

/// Has the Python tools draw the study, the comparison or the run in a folder. The interpreter is $TAMP_PYTHON where
/// that is set, or else the first of /usr/bin/python3 and python3 that has matplotlib. Throws FileError, which says
/// what to install and how to draw later; to be called after all figures are written.
void draw_page(const std::filesystem::path& folder);

}  // namespace tamp::tools
