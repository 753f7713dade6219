#include <fstream>
#include <sstream>

#include "tests/fuzz/readers.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/study/point_results.hpp"

namespace
{

namespace fs = std::filesystem;

/// The text with the checksum that it should have, where it has one.
std::string with_checksum(const fs::path& file)
{
  const std::string text = tamp::tools::read_input_file(file);
  std::optional<tamp::tools::Json> content = tamp::tools::json_of(text);
  if (!content || !content->is_object() || !content->contains("checksum")) return text;
  content->erase("checksum");
  (*content)["checksum"] = tamp::tools::hash_of(tamp::tools::json_text(*content));
  return tamp::tools::json_text(*content, 1);
}

}  // namespace

void tamp::fuzz::result(const std::filesystem::path& file)
{
  const fs::path folder = file.parent_path() / "key";
  fs::create_directories(folder);
  std::ofstream(folder / "result.json") << with_checksum(file);
  std::ofstream(folder / "history.csv") << "step,time[s]\n1,0.5\n";
  if (const auto result = tools::study::read_result(folder)) result->columns();
}
