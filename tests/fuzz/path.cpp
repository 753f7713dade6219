#include "tests/fuzz/readers.hpp"
#include "tools/run/drive/read_path.hpp"

void tamp::fuzz::path(const std::filesystem::path& file)
{
  tools::read_path(file);
}
