#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeVector;
using components::Passes;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

template <int D>
void mirror_terms(const Method<D>& method, const TaskContext& at, const GridView<NodeVector<D>>& terms)
{
  for_each_wall(method, at, terms.box(), [&](const Wall<D>& wall) { wall.image.mirror(terms.data()); });
}

/// u_0. The sum has it where nodes go on with the terms; particles that are given what their velocities lack have it
/// from the nodes.
template <int D>
runtime::TaskDeclaration first_term(const Method<D>& method)
{
  return runtime::task("first velocity term")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(node::sums<D>.halo(method.halo), node::motion<D>.halo(method.halo))
      .computes(node::velocity_term<D>.halo(method.halo), node::velocity_terms<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motion = data[node::motion<D>];
        const auto term = data[node::velocity_term<D>];
        const auto terms = data[node::velocity_terms<D>];
        const bool from_end = method.passes == Passes::from_end;
        for_each(sums.box(), [&](const Index& i) {
          const double mass = sums[i].mass();
          term[i] = terms[i] = {};
          if (from_end) {
            term[i].set(motion[i].velocity());
            terms[i] = term[i];
          } else if (mass > 0) {
            term[i].set(sums[i].momentum() / mass);
          }
        });
        mirror_terms(method, at, term);
      });
}

/// The last term goes to the particles, and what they bring of it back to the nodes.
template <int D>
runtime::TaskDeclaration return_term(const Method<D>& method, int pass)
{
  return runtime::task("return velocity term " + std::to_string(pass))
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(node::velocity_term<D>.halo(method.halo), particle::position<D>.previous(),
             particle::deformation_gradient<D>.previous(), particle::mass.previous())
      .accumulates(node::returned_momentum<D>.anew().halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto term = data[node::velocity_term<D>];
        const auto mass = data[particle::mass.previous()];
        const auto returned = data[node::returned_momentum<D>];
        const auto block = block_of<D>(at.layout, term);
        const auto places = places_at_start<D>(data);
        const components::Interpolation<D>& interpolation = method.interpolation(at.group);
        std::array<Vector<D>, motion_batch> buffer;
        for (std::size_t first = 0; first < places.size(); first += motion_batch) {
          const auto batch = places.subspan(first, std::min(motion_batch, places.size() - first));
          const auto momentum = std::span(buffer).first(batch.size());
          interpolation.interpolate(block, batch, term.data(), momentum);
          for (std::size_t p = 0; p < momentum.size(); ++p) momentum[p] *= mass[first + p];
          interpolation.add_vectors(block, batch, momentum, returned.data());
        }
        fold_images(method, at, returned, false);
      });
}

/// u_j = u_{j-1} - S+ S u_{j-1}. Where nodes go on with the terms, those on a wall that is no mirror keep the velocity
/// that it has left them.
template <int D>
runtime::TaskDeclaration next_term(const Method<D>& method, int pass)
{
  return runtime::task("velocity term " + std::to_string(pass))
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(node::sums<D>.halo(method.halo), node::returned_momentum<D>.halo(method.halo))
      .updates(node::velocity_term<D>.halo(method.halo), node::velocity_terms<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto returned = data[node::returned_momentum<D>];
        const auto term = data[node::velocity_term<D>];
        const auto terms = data[node::velocity_terms<D>];
        for_each(sums.box(), [&](const Index& i) {
          const double mass = sums[i].mass();
          if (mass > 0) term[i].set(term[i].value() - returned[i].value() / mass);
        });
        for_each_wall(method, at, term.box(), [&](const Wall<D>& wall) {
          if (method.passes == Passes::from_start || wall.traits.is_mirror) return;
          for_each_wall_node(wall, at.layout.grid(), term.box(), [&](const Index& i) { term[i] = {}; });
        });
        mirror_terms(method, at, term);
        for_each(sums.box(), [&](const Index& i) { terms[i] += term[i]; });
      });
}

template <int D>
runtime::TaskDeclaration move_nodes_by_terms(const Method<D>& method)
{
  return runtime::task("move nodes by velocity terms")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(node::velocity_terms<D>.halo(method.halo))
      .updates(node::motion<D>.halo(method.halo))
      .body([](const TaskContext&, auto data) {
        const auto terms = data[node::velocity_terms<D>];
        const auto motion = data[node::motion<D>];
        for_each(motion.box(), [&](const Index& i) { motion[i].set(terms[i].value(), motion[i].velocity_change()); });
      });
}

}  // namespace

/// The sums over all nodes of m_i u_j are zero but at walls: what S+ S brings to the nodes is what it took from them.
template <int D>
runtime::TaskList pass_velocities(const Method<D>& method)
{
  if (method.n_passes == 0 || method.deformable_materials.empty()) return {};
  runtime::TaskList tasks{first_term(method)};
  for (int pass = 1; pass <= method.n_passes; ++pass) {
    tasks.push_back(return_term(method, pass));
    tasks.push_back(next_term(method, pass));
  }
  if (method.passes == Passes::from_end) tasks.push_back(move_nodes_by_terms(method));
  return tasks;
}

template runtime::TaskList pass_velocities(const Method<2>&);
template runtime::TaskList pass_velocities(const Method<3>&);

}  // namespace tamp::tasks
