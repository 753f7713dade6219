#include "tools/run/profile_text.hpp"

#include <fmt/format.h>

#include "runtime/file_error.hpp"
#include "runtime/profile/report.hpp"
#include "tools/scene/parse_json.hpp"

namespace tamp::tools
{

namespace
{

/// Describes what is wrong with a profile that is JSON, in place of the library's text.
std::string damage(const nlohmann::json::exception& error)
{
  constexpr int key_not_found = 403;
  const std::string text = error.what();
  const std::size_t begin = text.find('\''), end = text.rfind('\'');
  if (error.id != key_not_found || begin == end) return "a value is not what it was written as";
  return fmt::format("the key \"{}\" is missing", text.substr(begin + 1, end - begin - 1));
}

template <class Render>
std::string rendered(const std::filesystem::path& file, const Render& render)
{
  if (!std::filesystem::exists(file)) throw InputError({file.string(), "no such file", "expected the folder of a run"});
  try {
    return render(nlohmann::json(parse_json(file)));
  } catch (const InputError& error) {
    throw runtime::FileError(file, std::string("is damaged: ") + error.what());
  } catch (const nlohmann::json::exception& error) {
    throw runtime::FileError(file, "is damaged: " + damage(error) + "; expected what a run has written");
  }
}

}  // namespace

std::string profile_text(const std::filesystem::path& file)
{
  return rendered(file, [](const nlohmann::json& profile) { return runtime::to_text(profile); });
}

std::string profile_json_text(const std::filesystem::path& file)
{
  return rendered(file, [](const nlohmann::json& profile) { return profile.dump(1) + "\n"; });
}

}  // namespace tamp::tools
