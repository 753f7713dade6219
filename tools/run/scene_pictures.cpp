#include "tools/run/scene_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "tools/run/field_reader.hpp"
#include "tools/run/raster.hpp"

namespace tamp::tools
{

namespace
{

/// Along the longer side of a picture: three to a particle of a coarse scene, and a page stays small.
constexpr int most_squares = 220;

/// The plane of the pictures: two axes, and a third along which a slab is shown, in space.
struct View {
  std::array<std::size_t, 2> axes{0, 1};
  std::size_t across = 2;
  double at = 0;
  double half_thickness = std::numeric_limits<double>::infinity();
};

/// Positions of particles at the start, and their velocity along each axis.
struct Whereabouts {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;
  Eigen::Vector3d fastest = Eigen::Vector3d::Zero();
};

/// The materials of bodies that move at the start, are driven or rigid; all where there is no such body.
std::vector<std::string> moving_materials(const Json& scene, const std::vector<std::string>& all)
{
  std::vector<std::string> moving;
  for (const auto& [name, body] : scene.at("bodies").items()) {
    const auto is_not_0 = [](const Json& v) { return v.is_number() && v != 0; };
    const bool has_velocity = body.contains("velocity") && std::ranges::any_of(body["velocity"], is_not_0);
    if (!has_velocity && body.at("driven").is_null() && body.at("rigid") != true) continue;
    const auto found = std::ranges::find(all, body.at("material").get<std::string>());
    if (found != all.end()) moving.push_back(*found);
  }
  return moving.empty() ? all : moving;
}

Whereabouts whereabouts(const FieldReader& fields, const std::string& output, const std::vector<std::string>& materials)
{
  Whereabouts found;
  for (const std::string& material : materials) {
    fields.for_each(output, material, [&](const StoredParticle& particle) {
      found.lower = found.lower.cwiseMin(particle.position);
      found.upper = found.upper.cwiseMax(particle.position);
      if (particle.velocity.allFinite()) found.fastest = found.fastest.cwiseMax(particle.velocity.cwiseAbs());
    });
  }
  return found;
}

double domain_bound(const Json& scene, const char* end, std::size_t axis)
{
  return scene.at("grid").at(end).at(axis).get<double>();
}

/// A domain has a cell at least; with larger ones each particle would fill the picture.
double cell_size_of(const Json& scene)
{
  const double size = scene.at("grid").at("cell_size").get<double>();
  const double width = domain_bound(scene, "upper", 0) - domain_bound(scene, "lower", 0);
  if (!(size > 0 && size < 1.001 * width)) throw std::out_of_range("the cell size");
  return size;
}

/// The plane of symmetry that particles of what moves touch, or else its middle.
double place_across(const Json& scene, const Whereabouts& moving, std::size_t axis)
{
  const std::string name(1, "xyz"[axis]);
  const auto lies_on = [&](const char* side, double gap) {
    const Json& face = scene.at("boundaries").at(name + side);
    return face == "symmetry" && std::abs(gap) < cell_size_of(scene);
  };
  const auto k = static_cast<Eigen::Index>(axis);
  const double lower = domain_bound(scene, "lower", axis), upper = domain_bound(scene, "upper", axis);
  const bool low = lies_on("-", moving.lower[k] - lower), high = lies_on("+", upper - moving.upper[k]);
  if (low != high) return low ? lower : upper;
  return (moving.lower[k] + moving.upper[k]) / 2;
}

View view_of(const Json& scene, const FieldReader& fields, const std::string& output)
{
  if (scene.at("dimension").get<int>() == 2) return {};
  const Whereabouts moving = whereabouts(fields, output, moving_materials(scene, fields.materials(output)));
  View view;
  view.across = moving.fastest[0] < moving.fastest[1] ? 0 : 1;
  view.axes = {1 - view.across, 2};
  view.half_thickness = cell_size_of(scene) / 2 * (1 + 1e-9);
  if (moving.lower.allFinite()) view.at = place_across(scene, moving, view.across);
  return view;
}

/// How far a particle of a material reaches: neighbours overlap a little, also where they are drawn apart.
double reach_of(const Json& scene, const std::string& material)
{
  const Json& own = scene.at("materials").at(material);
  const Json& per_axis =
      own.contains("particles_per_axis") ? own["particles_per_axis"] : scene.at("particles_per_cell").at(0);
  const double n = per_axis.is_number() ? per_axis.get<double>() : scene.at("particles_per_cell").at(0).get<double>();
  if (!(n >= 1)) throw std::out_of_range("particles per axis");
  return 0.62 * cell_size_of(scene) / n;
}

Raster raster_of(const Json& scene, const FieldReader& fields, const std::string& output, const View& view)
{
  std::array<double, 2> lower{}, upper{};
  for (std::size_t k = 0; k < 2; ++k) {
    lower[k] = domain_bound(scene, "lower", view.axes[k]);
    upper[k] = domain_bound(scene, "upper", view.axes[k]);
  }
  Raster raster(lower, upper, most_squares);
  const std::vector<std::string> there = fields.materials(output);
  int number = 0;
  for (const auto& [material, own] : scene.at("materials").items()) {
    const int m = number++;
    if (std::ranges::find(there, material) == there.end()) continue;
    const double reach = reach_of(scene, material);
    fields.for_each(output, material, [&](const StoredParticle& particle) {
      const auto along = [&](std::size_t axis) { return particle.position[static_cast<Eigen::Index>(axis)]; };
      const double off = std::isinf(view.half_thickness) ? 0 : std::abs(along(view.across) - view.at);
      if (off > view.half_thickness) return;
      raster.add({along(view.axes[0]), along(view.axes[1])}, reach, off, m, particle.velocity.norm());
    });
  }
  return raster;
}

/// Three digits of it; null where it is not known.
Json three_digits(double value)
{
  return std::isfinite(value) ? Json(std::stod(fmt::format("{:.3g}", value))) : Json(nullptr);
}

Json squares(const Raster& raster)
{
  std::vector<int> materials;
  Json speeds = Json::array();
  materials.reserve(raster.cells().size());
  for (const Raster::Cell& cell : raster.cells()) {
    materials.push_back(cell.material);
    speeds.push_back(cell.material == Raster::nobody ? Json(nullptr) : three_digits(cell.speed));
  }
  return {{"n", raster.n_cells()}, {"size", raster.cell_size()}, {"materials", materials}, {"speeds", speeds}};
}

Json axes_of(const Json& scene, const View& view)
{
  Json axes = Json::array();
  for (const std::size_t axis : view.axes) {
    axes.push_back({{"name", std::string(1, "xyz"[axis])},
                    {"lower", domain_bound(scene, "lower", axis)},
                    {"upper", domain_bound(scene, "upper", axis)}});
  }
  return axes;
}

}  // namespace

Json scene_pictures(const std::filesystem::path& run, const Json& scene)
{
  const std::filesystem::path file = run / "fields.h5";
  if (!std::filesystem::exists(file)) return Json::array();
  const FieldReader fields(file);
  if (fields.outputs().empty()) return Json::array();
  const View view = view_of(scene, fields, fields.outputs().front());
  std::vector<std::string> shown{fields.outputs().front()};
  if (fields.outputs().size() > 1) shown.push_back(fields.outputs().back());
  Json pictures = Json::array();
  for (const std::string& output : shown) {
    Json picture = squares(raster_of(scene, fields, output, view));
    picture["time_s"] = fields.time(output);
    picture["axes"] = axes_of(scene, view);
    picture["slab"] = nullptr;
    if (!std::isinf(view.half_thickness)) {
      picture["slab"] = {{"axis", std::string(1, "xyz"[view.across])}, {"at", view.at}};
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace tamp::tools
