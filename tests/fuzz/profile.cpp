#include "tests/fuzz/readers.hpp"
#include "tools/run/profile_text.hpp"

void tamp::fuzz::profile(const std::filesystem::path& file)
{
  const std::filesystem::path run = file.string() + ".run";
  std::filesystem::create_directories(run);
  std::filesystem::copy_file(file, run / "profile.json", std::filesystem::copy_options::overwrite_existing);
  tools::profile_text(run);
  tools::profile_text(run, {.as_json = true});
  tools::profile_text(run, {.patches = true});
  tools::profile_text(run, {.memory = true});
  tools::profile_text(run, {.chain = true});
  tools::profile_text(run, {.ranks = {0}});
  tools::profile_text(run, {.other = run});
}
