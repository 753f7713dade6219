#include "tools/scene/check_axisymmetry.hpp"

#include <fmt/format.h>

namespace tamp::tools
{

namespace
{

void check_grid(const JsonReader& grid, const tasks::Scene& scene)
{
  const double lower = scene.grid.lower[0];
  if (lower >= 0) return;
  grid.add_problem("lower", fmt::format("r = {} m, in an axisymmetric scene", lower),
                   "expected x from 0 on, as it is the distance from the axis");
}

void check_faces(const JsonReader& boundaries, const tasks::Scene& scene, bool reaches_axis)
{
  using components::traits_of, components::Beyond;
  const auto& [lower, upper] = scene.faces[0];
  if (traits_of(lower).beyond == Beyond::opposite || traits_of(upper).beyond == Beyond::opposite) {
    boundaries.add_problem("x-", "periodic in r, in an axisymmetric scene",
                           "expected other faces, as a ring that leaves outwards does not come in at the axis");
  } else if (reaches_axis && !traits_of(lower).is_mirror) {
    boundaries.add_problem("x-", "another face than \"symmetry\" on the axis of an axisymmetric scene",
                           "expected \"symmetry\", as nothing lies beyond r = 0");
  }
}

/// Whether a body moves away from the axis or towards it, or turns, as no rigid or given motion can.
void check_motion(const tasks::SceneBody& body, const JsonPointer& at, Document& document)
{
  const bool is_driven = body.drive.has_value();
  const bool moves_across = is_driven ? body.drive->motion.has_part_along(0) : body.velocity[0] != 0;
  if (moves_across) {
    document.add_problem(at / (is_driven ? "driven" : "velocity"), "a motion across the axis of an axisymmetric scene",
                         "expected one along y alone");
  }
  if (body.angular_velocity != tasks::Triple{0, 0, 0} || (is_driven && body.drive->turns)) {
    document.add_problem(at / (is_driven ? "driven" : "angular_velocity"),
                         "a rotation across the axis of an axisymmetric scene", "expected none");
  }
}

/// An axis by which the body is followed has to be that of the scene.
void check_nose(const tasks::SceneBody& body, const JsonPointer& at, Document& document)
{
  if (!body.axis) return;
  const auto check = [&](const char* key, const tasks::Triple& place) {
    if (place[0] == 0) return;
    document.add_problem(at / key, fmt::format("a place at r = {} m", place[0]),
                         "expected one on the axis of the scene, with x = 0");
  };
  check("nose", body.axis->nose);
  check("tail", body.axis->tail);
}

}  // namespace

void check_axisymmetry(const JsonReader& scene_reader, const tasks::Scene& scene, bool grid_is_good)
{
  JsonReader reader = scene_reader;
  if (grid_is_good) {
    check_grid(reader.object("grid"), scene);
    check_faces(reader.object("boundaries"), scene, scene.grid.lower[0] == 0);
  }
  if (scene.gravity[0] != 0) {
    reader.add_problem("gravity", fmt::format("{} m/s^2 across the axis of an axisymmetric scene", scene.gravity[0]),
                       "expected gravity along y alone");
  }
}

void check_axisymmetric_bodies(const tasks::Scene& scene, const JsonReader& bodies)
{
  Document& document = bodies.document();
  for (const tasks::SceneBody& body : scene.bodies) {
    const JsonPointer at = bodies.pointer(body.name);
    check_motion(body, at, document);
    check_nose(body, at, document);
  }
}

}  // namespace tamp::tools
