#include "tasks/report/sample_contact.hpp"

#include <algorithm>

#include "tasks/phases/contact_nodes.hpp"
#include "tasks/phases/contact_planes.hpp"
#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using components::ContactPlane;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

/// Whether two materials may push each other before they touch.
template <int D>
bool may_push_early(const Method<D>& method, int a, int b)
{
  const bool are_rigid = method.rigid_body(a) != nullptr && method.rigid_body(b) != nullptr;
  return !are_rigid && components::acts_apart(method.contacts.normal(a, b));
}

template <int D>
bool any_may_push_early(const Method<D>& method)
{
  const int n = static_cast<int>(method.materials.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (may_push_early(method, a, b)) return true;
    }
  }
  return false;
}

/// Lays a plane along the contact normal through the nodes at which two materials approach each other.
template <int D>
runtime::TaskDeclaration lay_planes_of_contact(const Method<D>& method)
{
  return runtime::task("lay planes of contact")
      .over_patches()
      .sparse(runtime::Sparsity::no_pair)
      .reads(node::sums<D>.halo(method.halo).every_group(), node::motion<D>.halo(method.halo).every_group())
      .computes(node::contact_plane<D>.halo(method.halo).every_group())
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motions = data[node::motion<D>];
        const auto planes = data[node::contact_plane<D>];
        const double threshold = contact_thresholds(method).surface_gradient;
        NodeOfMaterials<D> node;
        for_each(sums[0].box(), [&](const Index& i) {
          for (const GridView<ContactPlane<D>>& plane : planes) plane[i] = {};
          const auto pair = pair_alone_at(method, sums, i);
          if (!pair || !node.gather(method, sums, motions, {}, i)) return;
          const auto [a, b] = *pair;
          if (!may_push_early(method, static_cast<int>(a), static_cast<int>(b))) return;
          const auto normal = components::normal_at<D>(method.contacts, static_cast<int>(a), static_cast<int>(b),
                                                       node.surfaces(), threshold);
          if (!normal || !((node.velocity[a] - node.velocity[b]).dot(*normal) > 0)) return;
          planes[a][i].side = -1;
          planes[b][i].side = 1;
          planes[a][i].coefficients.template head<D>() = planes[b][i].coefficients.template head<D>() = *normal;
        });
        spread_planes(method, at, planes);
      });
}

/// With which two materials end their approach [N s]; a rigid body counts as one that nothing moves.
template <int D>
double normal_impulse(const Method<D>& method, const NodeOfMaterials<D>& node, const MaterialPair& pair,
                      const Vector<D>& normal)
{
  const auto inverse_mass = [&](std::size_t g) {
    return method.rigid_body(static_cast<int>(g)) == nullptr ? 1 / node.mass[g] : 0;
  };
  const double approach = (node.velocity[pair.first] - node.velocity[pair.second]).dot(normal);
  return approach / (inverse_mass(pair.first) + inverse_mass(pair.second));
}

template <int D>
ParticlePlace place_between(const runtime::Grid& grid, const Index& i, const MaterialPair& pair)
{
  std::int64_t number = 0;
  for (std::size_t k = D; k-- > 0;) number = number * (grid.n_cells[k] + 3) + i[k] + 1;
  ParticlePlace place = place_of<D>(number, static_cast<int>(pair.first), node_position<D>(grid, i));
  place.other_material = static_cast<int>(pair.second);
  return place;
}

template <int D>
runtime::TaskDeclaration measure_gaps(const Method<D>& method)
{
  return runtime::task("measure gaps")
      .over_patches()
      .sparse(runtime::Sparsity::no_pair)
      .reads(node::contact_plane<D>.halo(method.halo).every_group(), node::edge_sums<D>.halo(method.halo).every_group(),
             node::sums<D>.halo(method.halo).every_group(), node::motion<D>.halo(method.halo).every_group())
      .reduces(contact_sample)
      .body([&method](const TaskContext& at, auto data) {
        const auto planes = data[node::contact_plane<D>];
        const auto edges = data[node::edge_sums<D>];
        const auto sums = data[node::sums<D>];
        const auto motions = data[node::motion<D>];
        ContactSample& sample = data[contact_sample];
        const runtime::IndexBox counted = counted_nodes(method, at);
        NodeOfMaterials<D> node;
        for_each(planes[0].box(), [&](const Index& i) {
          const auto pair = parted_at(planes, i);
          if (!pair || !counted.contains(i) || !node.gather(method, sums, motions, {}, i)) return;
          const auto& [a, b] = *pair;
          if (!(edges[a][i].weight > 0 && edges[b][i].weight > 0)) return;
          const double impulse = normal_impulse<D>(method, node, *pair, planes[a][i].normal());
          const double gap = -(edge_at<D>(method, a, edges[a][i]) + edge_at<D>(method, b, edges[b][i]));
          sample.add(gap / method.cell_size, impulse, place_between<D>(at.layout.grid(), i, *pair));
        });
      });
}

}  // namespace

template <int D>
runtime::TaskList contact_sample_tasks(const Method<D>& method)
{
  if (!any_may_push_early(method) || method.stress_timing == StressTiming::usf) return {};
  runtime::TaskList tasks;
  for (const runtime::TaskList& phase :
       {share_stress(method), particles_to_grid(method), accelerate_nodes(method, false),
        accelerate_rigid_bodies(method), rigid_nodes_before_contact(method),
        runtime::TaskList{lay_planes_of_contact(method), find_edges(method), measure_gaps(method)}}) {
    tasks.insert(tasks.end(), phase.begin(), phase.end());
  }
  return tasks;
}

template <int D>
runtime::HostData contact_sample_data(const Method<D>& method)
{
  if (contact_sample_tasks(method).empty()) return {};
  runtime::HostData data{{&particle::position<D>, &particle::deformation_gradient<D>, &particle::velocity<D>,
                          &particle::mass, &particle::volume, &particle::stress<D>, &particle::viscous_pressure},
                         {&contact_sample}};
  if (!method.rigid_bodies.empty()) data.state.push_back(&rigid_states);
  if (method.brings_gradients()) data.state.push_back(&particle::velocity_gradient<D>);
  if (method.brings_moments()) data.state.push_back(&particle::velocity_moment<D>);
  return data;
}

template runtime::HostData contact_sample_data(const Method<2>&);
template runtime::HostData contact_sample_data(const Method<3>&);
template runtime::TaskList contact_sample_tasks(const Method<2>&);
template runtime::TaskList contact_sample_tasks(const Method<3>&);

}  // namespace tamp::tasks
