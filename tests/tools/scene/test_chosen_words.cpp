#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/keys/chosen_words.hpp"

namespace test_chosen_words
{

using namespace tamp;
using namespace tamp::test;

TEST_CASE("the words of a scene are found wherever they stand, each with its own meaning")
{
  const TemporaryFolder folder;
  const auto file = write_scene_with_sand(folder);
  const auto scene = tools::read_scene(file, {"/interpolator=cubic_spline", "/boundaries/y+=open"});

  const tools::Json words = tools::chosen_words(scene.resolved);

  const auto at = [&](const std::string& key) {
    const auto found = std::ranges::find_if(words, [&](const auto& word) { return word["key"] == key; });
    return found == words.end() ? tools::Json() : *found;
  };
  CHECK(at("/interpolator")["word"] == "cubic_spline");
  CHECK(at("/interpolator")["meaning"] == "cubic B-splines");
  CHECK(at("/interpolator")["about"] == "how far particles reach, and with what weights: ");
  CHECK(at("/boundaries/y+")["word"] == "open");
  CHECK(at("/boundaries/y-")["word"] == "symmetry");
  CHECK(at("/materials/sand/elastic_update")["word"] == "rate");
  CHECK(at("/materials/sand/modulus/type")["word"] == "table");
  CHECK(at("/bodies/block/particles")["word"] == "lattice");
  CHECK(at("/grid").is_null());
}

TEST_CASE("a scene that holds something else in the place of objects has no words there")
{
  CHECK(
      tools::chosen_words(tools::Json::parse(R"({"boundaries": 3, "materials": {"a": []}, "contact": [1]})")).empty());
}

}  // namespace test_chosen_words
