#pragma once

#include <filesystem>
#include <string>

namespace tamp::tools
{

/// Has a script of `tools/python`, such as "draw_compare.py", draw what lies in a folder. The interpreter is
/// $TAMP_PYTHON where that is set, or else the first of /usr/bin/python3 and python3 that has matplotlib. Throws
/// FileError, which says what to install and how to draw later; to be called after all figures are written.
void draw_page(const std::string& script, const std::filesystem::path& folder);

}  // namespace tamp::tools
