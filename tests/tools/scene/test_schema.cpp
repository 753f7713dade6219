#include <catch2/catch.hpp>

#include <fstream>

#include "tools/scene/keys/schema.hpp"

namespace test_schema
{

using namespace tamp;

namespace
{

/// The tables of a Markdown file: lines that follow each other and start with a bar.
std::vector<std::string> tables_of(const std::filesystem::path& file)
{
  std::vector<std::string> tables;
  std::ifstream stream(file);
  bool within = false;
  for (std::string line; std::getline(stream, line);) {
    const bool is_row = line.starts_with('|');
    if (is_row && !within) tables.emplace_back();
    if (is_row) tables.back() += line + "\n";
    within = is_row;
  }
  return tables;
}

}  // namespace

// `tamp schema --format markdown` prints them.
TEST_CASE("the tables of docs/reference/scene.md are those of the declared keys")
{
  const std::vector<std::string> written = tables_of(TAMP_SOURCE_DIR "/docs/reference/scene.md");
  const std::vector<std::string> declared = tools::key_tables();

  REQUIRE(written.size() == declared.size());
  for (std::size_t i = 0; i < declared.size(); ++i) CHECK(written[i] == declared[i]);
}

TEST_CASE("the schema tells an editor unit, default and range of a key")
{
  const tools::Json schema = tools::scene_schema();

  const tools::Json& step = schema.at("/definitions/scene/else/properties/time/properties/minimum_step"_json_pointer);
  CHECK(step.at("description") == "the run stops as unstable if its time step has to be shorter [s]");
  CHECK(step.at("default") == 1e-12);
  CHECK(step.at("exclusiveMinimum") == 0);
  const tools::Json& material = schema.at("/definitions/material/else"_json_pointer);
  CHECK(material.at("/properties/type/enum/0"_json_pointer) == "hypoelastic");
  CHECK(material.at("/allOf/0/then/properties/density/description"_json_pointer) ==
        "of the unstrained material [kg/m³]; default: compulsory, but with `relative_density`");
}

TEST_CASE("the schema names the pages that the text of a key links")
{
  const tools::Json schema = tools::scene_schema();

  const tools::Json& scene = schema.at("/definitions/scene/else/properties"_json_pointer);
  CHECK_THAT(scene.at("/time/properties/rule/description"_json_pointer).get<std::string>(),
             Catch::EndsWith(", see docs/explanation/method.md"));
  CHECK_THAT(scene.at("/output/properties/history_interval/description"_json_pointer).get<std::string>(),
             Catch::Contains(" are listed in docs/reference/output.md [s]"));
}

}  // namespace test_schema
