#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>

#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/readers.hpp"
#include "tools/scene/files/input_file.hpp"

namespace test_corpora
{

namespace
{

namespace fs = std::filesystem;

using Reader = void (*)(const fs::path&);

#define READER(name)        \
  {                         \
#    name, tamp::fuzz::name \
  }
const std::map<std::string, Reader> readers{READER(scene),
                                            READER(study),
                                            READER(profile),
                                            READER(history),
                                            READER(result),
                                            READER(run_lock),
                                            READER(csv_table),
                                            READER(yield_table),
                                            READER(path),
                                            READER(modulus_states),
                                            READER(unloading_curves),
                                            READER(published_table),
                                            READER(support_vectors),
                                            READER(network),
                                            READER(mesh),
                                            READER(checkpoint)};
#undef READER

}  // namespace

TEST_CASE("whatever fuzzing has kept is read or refused by its reader")
{
  const tamp::fuzz::InputFile input;
  std::map<std::string, int> n_read;

  for (const auto& entry : fs::recursive_directory_iterator(TAMP_SOURCE_DIR "/tests/fuzz/corpus")) {
    if (!entry.is_regular_file()) continue;
    const std::string reader = entry.path().parent_path().filename();
    INFO(entry.path());
    const std::string bytes = tamp::tools::read_input_file(entry.path());
    CHECK_NOTHROW(input.read_by(readers.at(reader), bytes.data(), bytes.size()));
    ++n_read[reader];
  }

  CHECK(n_read.size() == readers.size());
}

}  // namespace test_corpora
