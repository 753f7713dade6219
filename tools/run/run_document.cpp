#include "tools/run/run_document.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "runtime/file_error.hpp"
#include "tools/scene/json/parse_json.hpp"

namespace tamp::tools
{

namespace
{

/// Describes what is wrong with a document that is JSON, in place of the library's text.
std::string damage(const nlohmann::json::exception& error)
{
  constexpr int key_not_found = 403;
  const std::string text = error.what();
  const std::size_t begin = text.find('\''), end = text.rfind('\'');
  if (error.id != key_not_found || begin == end) return "a value is not what it was written as";
  return fmt::format("the key \"{}\" is missing", text.substr(begin + 1, end - begin - 1));
}

Json read_document(const std::filesystem::path& file)
{
  if (!std::filesystem::exists(file)) {
    throw runtime::FileError(file, "is missing: the run has not come to its end, or the file was removed");
  }
  try {
    return parse_json(file);
  } catch (const InputError& error) {
    throw runtime::FileError(file, std::string("is damaged: ") + error.what());
  }
}

}  // namespace

void with_run_document(const std::filesystem::path& file, const std::function<void(const Json&)>& use)
{
  const Json document = read_document(file);
  try {
    use(document);
  } catch (const nlohmann::json::exception& error) {
    throw runtime::FileError(file, "is damaged: " + damage(error) + "; expected what a run has written");
  } catch (const std::out_of_range&) {
    throw runtime::FileError(file, "is damaged: a value is out of range; expected what a run has written");
  }
}

}  // namespace tamp::tools
