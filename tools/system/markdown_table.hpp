#pragma once

#include <string>
#include <vector>

namespace tamp::tools
{

/// A table in Markdown, its first row the head. Columns are as wide as their widest cells, so that it can be read as it
/// is too.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace tamp::tools
