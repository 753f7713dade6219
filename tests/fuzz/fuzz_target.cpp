#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/readers.hpp"

/// Called by libFuzzer with each input, for the reader that this is compiled for.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t n_bytes)
{
  static const tamp::fuzz::InputFile input;
  input.read_by(tamp::fuzz::TAMP_READER, reinterpret_cast<const char*>(bytes), n_bytes);
  return 0;
}
