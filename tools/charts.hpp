#pragma once

#include <filesystem>
#include <string>

namespace tamp::tools
{

void draw_page(const std::string& script, const std::filesystem::path& folder);

}  // namespace tamp::tools
