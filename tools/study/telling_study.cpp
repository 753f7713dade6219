#include "tools/study/telling_study.hpp"

#include <fmt/format.h>

#include <Eigen/Core>

#include "tools/advice/penetration.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools::study
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* cell_size_key = "/grid/cell_size";

/// The settings of options `--set`, as a study has them: with files named from the study's folder.
Json settings_of(const std::vector<std::string>& assignments)
{
  Json settings = Json::object();
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    const std::string text = assignment.substr(equals + 1);
    Json value = json_of(text).value_or(Json(text));
    std::error_code none;
    if (value.is_string() && fs::exists(fs::path(value.get<std::string>()), none)) {
      value = fs::absolute(value.get<std::string>()).string();
    }
    settings[assignment.substr(0, equals)] = value;
  }
  return settings;
}

/// The setting for a single patch, which is wide enough on any cells.
Json one_patch(const tasks::Scene& scene)
{
  return Json(std::vector<int>(static_cast<std::size_t>(scene.grid.dimension), 1));
}

bool can_be_read(const fs::path& file, std::vector<std::string> assignments, const tasks::Scene& scene,
                 const Json& settings)
{
  assignments.push_back("/grid/patches=" + one_patch(scene).dump());
  for (const auto& [pointer, value] : settings.items()) assignments.push_back(pointer + "=" + value.dump());
  try {
    read_scene(file, assignments);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Three grids, from coarse to fine; the scene's own is the middle one, or the first where coarser cells do not fit.
Json cell_sizes(const fs::path& file, const std::vector<std::string>& assignments, const tasks::Scene& scene)
{
  const double own = scene.grid.cell_size;
  const bool fits = can_be_read(file, assignments, scene, {{cell_size_key, 2 * own}});
  return fits ? Json{2 * own, own, own / 2} : Json{own, own / 2, own / 4};
}

Json methods_of(const fs::path& file, const std::vector<std::string>& assignments, const tasks::Scene& scene)
{
  const auto& other = scene.grid.dimension == 2 ? Json{{"/interpolator", "cubic_spline"},
                                                       {"/transfer", "flip"},
                                                       {"/artificial_viscosity", {{"linear", 1}, {"quadratic", 4}}}}
                                                : Json{{"/interpolator", "gimp"}, {"/transfer", "tflip"}};
  Json methods{{{"name", "as it is"}, {"set", Json::object()}}};
  if (can_be_read(file, assignments, scene, other)) {
    methods.push_back({{"name", "on the front of cost and error"}, {"set", other}});
  }
  return methods;
}

/// The quantities of bodies that go into others or are pressed; where there are none, of all that move.
Json quantities_of(const tasks::Scene& scene)
{
  Json of_those_that_enter = Json::array(), of_all = Json::array();
  bool is_driven = false;
  for (const tasks::SceneBody& body : scene.bodies) {
    const bool enters = penetration_of(scene, body) || body.pressure;
    const bool moves = enters || body.rigid || Eigen::Vector3d(body.velocity.data()).norm() > 0;
    is_driven = is_driven || body.drive;
    if (!moves || body.drive) continue;
    const Json depth{{"name", "depth of " + body.name}, {"column", body.name + ".depth[m]"}, {"take", "last"}};
    of_all.push_back(depth);
    if (enters) of_those_that_enter.push_back(depth);
  }
  Json chosen = of_those_that_enter.empty() ? of_all : of_those_that_enter;
  // A driven body goes as deep on any grid; what drives it is the mean force times that way.
  if (is_driven) chosen.push_back({{"name", "work"}, {"column", "external[J]"}, {"take", "last"}});
  return chosen;
}

}  // namespace

Json telling_study(const CheckedScene& checked, const fs::path& file, const std::vector<std::string>& assignments,
                   const fs::path& folder)
{
  const tasks::Scene& scene = checked.scene;
  const Json quantities = quantities_of(scene);
  if (quantities.empty()) {
    throw InputError({"--study", "no body of the scene moves at its start, is driven or pressed",
                      "expected one whose depth or force a study could tell"});
  }
  Json settings = settings_of(assignments);
  settings["/grid/patches"] = one_patch(scene);
  const Json sizes = cell_sizes(file, assignments, scene);
  return {{"title", fmt::format("How far {} is off on its cells and by its method", scene.name)},
          {"about",
           "Each method is compared with what it tends to itself on these three grids. The finest takes a multiple of "
           "the time: `tamp check` with its cell size says how much."},
          {"measure", {{"run", fs::proximate(fs::absolute(file), fs::absolute(folder)).string()}}},
          {"set", settings},
          {"methods", methods_of(file, assignments, scene)},
          {"sweep", {{cell_size_key, sizes}}},
          {"refine", cell_size_key},
          {"quantities", quantities},
          {"reference", {{"of_each_method", true}, {"refine", cell_size_key}, {"values", sizes}}},
          {"repeat", 1}};
}

}  // namespace tamp::tools::study
