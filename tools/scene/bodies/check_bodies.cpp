#include "tools/scene/bodies/check_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "components/errors.hpp"
#include "tasks/rigid_body.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tasks/set_up/settled_ground.hpp"
#include "tools/scene/bodies/symmetry.hpp"
#include "tools/scene/json/place_text.hpp"

namespace tamp::tools
{

namespace
{

/// The first particle of one body that lies in the solid of another.
template <int D>
std::optional<Vector<D>> first_within(const tasks::Scene& scene, const tasks::SceneBody& body,
                                      const tasks::SceneBody& other)
{
  const auto& solid = std::get<components::Solid<D>>(other.solid);
  for (const Vector<D>& site : tasks::sites_of<D>(scene, body)) {
    if (solid.contains(site)) return site;
  }
  return std::nullopt;
}

template <int D>
void check_no_overlap(const tasks::Scene& scene, const JsonReader& bodies)
{
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const tasks::SceneBody &body = scene.bodies[i], &other = scene.bodies[j];
      auto place = first_within<D>(scene, body, other);
      // Either may have the finer particles.
      if (!place) place = first_within<D>(scene, other, body);
      if (!place) continue;
      bodies.add_problem(body.name, fmt::format("overlaps body \"{}\", at {}", other.name, text<D>(*place)),
                         "expected bodies that share no particle");
    }
  }
}

/// The nodes to which the particles of a body give mass.
template <int D>
std::set<runtime::Index> nodes_of(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  const double reach = scene.reach_of(body.material);
  std::set<runtime::Index> nodes;
  for (const Vector<D>& x : tasks::sites_of<D>(scene, body)) {
    runtime::IndexBox reached{{0, 0, 0}, {1, 1, 1}};
    for (std::size_t k = 0; k < D; ++k) {
      const double place = (x[static_cast<int>(k)] - scene.grid.lower[k]) / scene.grid.cell_size;
      reached.lower[k] = static_cast<int>(std::floor(place - reach)) + 1;
      reached.upper[k] = static_cast<int>(std::ceil(place + reach));
    }
    for_each(reached, [&](const runtime::Index& node) { nodes.insert(node); });
  }
  return nodes;
}

template <int D>
bool share_a_node(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& other)
{
  const auto nodes = nodes_of<D>(scene, body), others = nodes_of<D>(scene, other);
  return std::any_of(nodes.begin(), nodes.end(), [&](const auto& node) { return others.contains(node); });
}

template <int D>
void check_rigid(const tasks::Scene& scene, const tasks::SceneBody& body, const JsonReader& bodies)
{
  const auto touchable = tasks::touchable_mirrors(scene, body);
  const auto is_clear_of_edges = [&](const Vector<D>& x) {
    return tasks::is_clear_of_edges<D>(scene.grid, scene.reach_of(body.material), touchable, x);
  };
  const auto places = tasks::sites_of<D>(scene, body);
  if (!std::all_of(places.begin(), places.end(), is_clear_of_edges)) {
    bodies.add_problem(body.name, "rigid, and less than a cell from the edge of the grid",
                       "expected all nodes that it reaches to lie within the grid, but for \"symmetry\" faces on "
                       "which it lies or along which it is driven without turning");
  }
  for (const tasks::SceneBody& other : scene.bodies) {
    if (&other == &body) continue;
    if (other.material == body.material) {
      bodies.add_problem(body.name, fmt::format("rigid, but of one material with body \"{}\"", other.name),
                         "expected a material of its own");
    } else if (other.rigid && &other < &body && share_a_node<D>(scene, body, other)) {
      bodies.add_problem(body.name,
                         fmt::format("rigid, and so near to the rigid body \"{}\" that they meet", other.name),
                         "expected one of them to be deformable, or no node of the grid that both reach");
    }
  }
}

/// Can the body have settled, and can it bear the stress that it is to start with?
template <int D>
void check_settled(const tasks::Scene& scene, const tasks::SceneBody& body, const JsonReader& bodies)
{
  try {
    const tasks::SettledGround<D> settled(scene, body);
    for (const Vector<D>& x : tasks::sites_of<D>(scene, body)) settled.check_at(x);
  } catch (const components::BadValue& bad) {
    bodies.document().add_problem(bodies.pointer(body.name) / "initial_stress", bad.found, "expected " + bad.expected);
  }
}

/// A body at a plane of symmetry, whose whole does what its image does, too.
struct MirroredBody {
  const tasks::Scene& scene;
  const tasks::SceneBody& body;
  std::size_t axis;
  std::size_t side;
  const JsonReader& root;

  std::string plane() const { return fmt::format("{}{}", "xyz"[axis], "-+"[side]); }

  double place() const
  {
    return scene.grid.coordinate(static_cast<int>(axis), side == 0 ? 0 : scene.grid.n_cells[axis]);
  }

  void add_problem(const std::string& key, const std::string& found) const
  {
    add_problem(root.pointer("bodies") / body.name / key, found);
  }

  void add_problem(const JsonPointer& at, const std::string& found) const
  {
    root.document().add_problem(at, fmt::format("{} the plane of symmetry {}, on which the body lies", found, plane()),
                                "expected what the mirror image in that plane has, too");
  }

  void check_motion() const
  {
    const bool is_driven_across = body.drive && body.drive->motion.has_part_along(static_cast<int>(axis));
    if (is_driven_across) add_problem("driven", "a motion across");
    if (!body.drive && body.velocity[axis] != 0) add_problem("velocity", "a velocity across");
    for (std::size_t k = 0; k < 3; ++k) {
      if (k != axis && body.angular_velocity[k] != 0)
        return add_problem("angular_velocity", "a spin that turns it out of");
    }
  }

  void check_axis() const
  {
    if (!body.axis) return;
    const auto is_off = [&](const tasks::Triple& end) {
      return std::abs(end[axis] - place()) > 1e-9 * scene.grid.cell_size;
    };
    if (is_off(body.axis->nose)) add_problem("nose", "a place beside");
    if (is_off(body.axis->tail)) add_problem("tail", "a place beside");
  }

  /// A box that ends at the plane stands for itself and its image. One apart from the plane would press the whole on
  /// one side alone.
  template <int D>
  void check_pressure() const
  {
    if (!body.pressure) return;
    const int k = static_cast<int>(axis);
    const components::Box<D> part = std::get<components::Solid<D>>(body.solid).bounding_box();
    const double reach = side == 0 ? part.upper[k] - place() : place() - part.lower[k];
    const components::PressedBox<3>& box = body.pressure->box;
    const double end = side == 0 ? box.lower[k] : box.upper[k];
    const bool ends_at_plane = std::abs(end - place()) <= 1e-9 * scene.grid.cell_size;
    if (ends_at_plane || is_mirrored(box, axis, place(), reach)) return;
    add_problem(root.pointer("bodies") / body.name / "pressure" / "within",
                "a box that is not symmetric about, and does not end at,");
  }
};

/// The planes of symmetry that a body is cut by, or held on.
tasks::Sides planes_through(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  if (!body.rigid || (body.drive && !body.drive->turns)) return body.cut;
  return tasks::mirrors_beneath(scene, body);
}

/// The loads of a scene with a plane of symmetry, on which a body lies.
void check_mirrored_loads(const tasks::Scene& scene, const tasks::SceneBody& body, std::size_t axis, std::size_t side,
                          const JsonReader& root)
{
  if (loads_are_mirrored(scene, axis)) return;
  const std::string of =
      fmt::format(" the plane of symmetry {}{}, on which body \"{}\" lies", "xyz"[axis], "-+"[side], body.name);
  if (scene.gravity[axis] != 0) return root.add_problem("gravity", "a part across" + of, "expected gravity along it");
  root.add_problem("centrifuge", "an axis that is not the normal of" + of,
                   "expected another frame, as the Coriolis force drives motion in the plane out of it");
}

/// How deep the places of a body's particles lie within its solid at most [m].
template <int D>
double greatest_depth(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  double greatest = 0;
  for (const Vector<D>& place : tasks::sites_of<D>(scene, body)) {
    greatest = std::max(greatest, -std::get<components::Solid<D>>(body.solid).distance(place).value);
  }
  return greatest;
}

}  // namespace

void check_solid(const JsonReader& reader, const tasks::Scene& scene, const tasks::SceneContact& contact)
{
  if (!std::holds_alternative<components::SolidNormal>(contact.normal) || scene.bodies.empty()) return;
  const bool first_is_rigid = scene.is_rigid(contact.material_a);
  if (first_is_rigid == scene.is_rigid(contact.material_b)) {
    reader.add_problem("normal", first_is_rigid ? "solid, between two rigid bodies" : "solid, and no rigid body",
                       "expected one of the two materials to be a rigid body, or another normal");
    return;
  }
  const int rigid = first_is_rigid ? contact.material_a : contact.material_b,
            other = first_is_rigid ? contact.material_b : contact.material_a;
  const double size = scene.grid.cell_size / scene.particles_per_axis_of(other);
  for (const tasks::SceneBody& body : scene.bodies) {
    if (body.material != rigid) continue;
    const double depth = scene.grid.dimension == 2 ? greatest_depth<2>(scene, body) : greatest_depth<3>(scene, body);
    if (4 * depth >= size) continue;
    reader.add_problem(
        "normal", fmt::format("solid, of body \"{}\", which is about {:.2g} m thick", body.name, 2 * depth),
        fmt::format("expected a body at least half as thick as the particles that touch it, {:.2g} m, so "
                    "that these have sides to lie on",
                    size));
  }
}

void check_mirrored_bodies(const tasks::Scene& scene, const JsonReader& root)
{
  tasks::Sides seen{};
  for (const tasks::SceneBody& body : scene.bodies) {
    const tasks::Sides planes = planes_through(scene, body);
    for (std::size_t axis = first_axis_with_planes(scene); axis < 3; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        if (!planes[axis][side]) continue;
        const MirroredBody mirrored{scene, body, axis, side, root};
        mirrored.check_motion();
        // Between two walls it may be anywhere.
        if (!planes[axis][1 - side]) mirrored.check_axis();
        scene.grid.dimension == 2 ? mirrored.check_pressure<2>() : mirrored.check_pressure<3>();
        if (!seen[axis][side]) check_mirrored_loads(scene, body, axis, side, root);
        seen[axis][side] = true;
      }
    }
  }
}

void check_no_overlap(const tasks::Scene& scene, const JsonReader& bodies)
{
  scene.grid.dimension == 2 ? check_no_overlap<2>(scene, bodies) : check_no_overlap<3>(scene, bodies);
}

void check_rigid_bodies(const tasks::Scene& scene, const JsonReader& bodies)
{
  for (const tasks::SceneBody& body : scene.bodies) {
    if (!body.rigid) continue;
    scene.grid.dimension == 2 ? check_rigid<2>(scene, body, bodies) : check_rigid<3>(scene, body, bodies);
  }
}

void check_settled_bodies(const tasks::Scene& scene, const JsonReader& bodies)
{
  for (const tasks::SceneBody& body : scene.bodies) {
    if (!body.initial_stress) continue;
    scene.grid.dimension == 2 ? check_settled<2>(scene, body, bodies) : check_settled<3>(scene, body, bodies);
  }
}

}  // namespace tamp::tools
