#include "tools/scene/check_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "tasks/rigid_body.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tools/scene/place_text.hpp"

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
  const auto touchable = tasks::touchable_faces(scene, body);
  const auto is_off_edges = [&](const Vector<D>& x) {
    return tasks::is_off_edges<D>(scene.grid, scene.reach_of(body.material), touchable, x);
  };
  const auto places = tasks::sites_of<D>(scene, body);
  if (!std::all_of(places.begin(), places.end(), is_off_edges)) {
    bodies.add_problem(body.name, "rigid, and less than a cell from the edge of the grid",
                       "expected all nodes that it reaches to lie within the grid, but for \"symmetry\" faces along "
                       "which it is driven without turning");
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

}  // namespace

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

}  // namespace tamp::tools
