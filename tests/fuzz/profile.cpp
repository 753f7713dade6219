#include "tests/fuzz/readers.hpp"
#include "tools/run/profile_text.hpp"

void tamp::fuzz::profile(const std::filesystem::path& file)
{
  tools::profile_text(file);
  tools::profile_json_text(file);
}
