#include "tools/study/study.hpp"
#include "tests/fuzz/readers.hpp"
#include "tools/system/errors.hpp"

void tamp::fuzz::study(const std::filesystem::path& file)
{
  try {
    tools::study::read_study(file, true);
  } catch (const tools::InputError&) {
  }
  tools::study::read_study(file, false);
}
