#include "tools/charts.hpp"

namespace tamp::tools
{

void draw_page(const std::string&, const std::filesystem::path&) {}

}  // namespace tamp::tools
