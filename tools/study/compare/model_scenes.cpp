#include "tools/study/compare/model_scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/system/suggestion.hpp"

namespace tamp::tools::compare
{

namespace
{

constexpr std::string_view compiled_suffix = "-compiled";

/// By how much p and K of a compiled model may differ from the model it was made of, relative.
std::string compile_tolerance(const std::string& type)
{
  double tolerance = 0;
  components::for_each_named_modulus([&]<class Model>(std::type_identity<Model>) {
    if (type == Model::type) tolerance = Model::compile_tolerance;
  });
  return fmt::format("{}", tolerance);
}

void check_model(const std::string& name)
{
  const std::vector<std::string>& known = model_names();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError({"--models", "\"" + name + "\"",
                    meant_or(name, known, fmt::format("expected some of {}", fmt::join(known, ", ")))});
}

std::vector<std::string> sand_names(const tasks::Scene& scene)
{
  std::vector<std::string> names;
  for (const tasks::SceneMaterial& material : scene.materials) {
    if (std::holds_alternative<components::TabularCap>(material.model)) names.push_back(material.name);
  }
  return names;
}

std::vector<std::string> assignments_of(const std::string& model, const std::vector<std::string>& sands)
{
  const bool compiled = model.ends_with(compiled_suffix);
  const std::string type = compiled ? model.substr(0, model.size() - compiled_suffix.size()) : model;
  std::vector<std::string> assignments;
  for (const std::string& sand : sands) {
    const JsonPointer modulus = JsonPointer("/materials") / sand / "modulus";
    assignments.push_back((modulus / "type").to_string() + "=" + type);
    // A null takes away what the material's file may say.
    assignments.push_back((modulus / "compile").to_string() + "=" + (compiled ? compile_tolerance(type) : "null"));
  }
  return assignments;
}

}  // namespace

const std::vector<std::string>& model_names()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all, compiled;
    components::for_each_named_modulus([&]<class Model>(std::type_identity<Model>) {
      all.emplace_back(Model::type);
      compiled.push_back(all.back() + std::string(compiled_suffix));
    });
    all.insert(all.end(), compiled.begin(), compiled.end());
    return all;
  }();
  return names;
}

std::vector<ModelScene> read_model_scenes(const std::filesystem::path& file,
                                          const std::vector<std::string>& assignments,
                                          const std::vector<std::string>& models)
{
  for (const std::string& model : models) check_model(model);
  const std::vector<std::string> sands = sand_names(read_scene(file, assignments).scene);
  if (sands.empty()) {
    throw InputError({file.string() + "#/materials", "none of type tabular_cap", "expected one whose models differ"});
  }
  std::vector<ModelScene> scenes;
  for (auto model = models.begin(); model != models.end(); ++model) {
    const auto earlier = std::count(models.begin(), model, *model);
    std::vector<std::string> all = assignments;
    const std::vector<std::string> own = assignments_of(*model, sands);
    all.insert(all.end(), own.begin(), own.end());
    CheckedScene scene = read_scene(file, all);
    scenes.push_back({earlier == 0 ? *model : fmt::format("{}-{}", *model, earlier + 1), all, std::move(scene)});
  }
  return scenes;
}

}  // namespace tamp::tools::compare
