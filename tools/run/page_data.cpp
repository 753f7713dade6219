#include "tools/run/page_data.hpp"

#include "runtime/file_error.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tools/run/run_document.hpp"
#include "tools/run/run_folder.hpp"
#include "tools/run/scene_pictures.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/keys/chosen_words.hpp"

namespace tamp::tools
{

namespace
{

/// Without them a page has all else, so that a damaged file of fields is no more than the reason why. What is no file
/// at all, such as a pipe, is an error all the same: whoever reads it would wait for ever.
void add_pictures(const std::filesystem::path& run, const Json& scene, Json& data)
{
  data["pictures"] = Json::array();
  try {
    data["pictures"] = scene_pictures(run, scene);
  } catch (const runtime::FileError& error) {
    const std::filesystem::path fields = run / "fields.h5";
    if (std::filesystem::exists(fields) && !std::filesystem::is_regular_file(fields)) throw;
    data["no_pictures"] = error.what();
  }
}

}  // namespace

void expect_page(const std::filesystem::path& run)
{
  note_files_of_run(run);  // some of them are read by Python
  expect_results(run, {"page.json", "report.html"});
}

void write_page_data(const std::filesystem::path& run)
{
  Json data;
  with_run_document(run / "scene.json", [&](const Json& scene) {
    data["materials"] = Json::array();
    for (const auto& [name, material] : scene.at("materials").items()) data["materials"].push_back(name);
    add_pictures(run, scene, data);
    data["words"] = chosen_words(scene);
  });
  runtime::write_whole_file(run / "page.json", json_text(data) + "\n");
}

}  // namespace tamp::tools
