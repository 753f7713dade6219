#include "tasks/phases/contact_planes.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"

namespace tamp::tasks
{

using components::ContactFace;
using components::ContactPlane;
using components::EdgeSums;
using components::NodeMotion;
using components::NodeSums;
using components::RegressionSums;
using runtime::GridView;
using runtime::Index;
using runtime::PerGroup;
using runtime::TaskContext;

namespace
{

/// The pair that gets a plane at a node, where no third material is: its own contact with either would take their
/// plane's normal for theirs. Where three meet, all pairs take the normal of the flatter surface.
template <int D>
std::optional<MaterialPair> pair_at(const Method<D>& method, const PerGroup<GridView<const NodeSums<D>>>& sums,
                                    const Index& i)
{
  const auto pair = pair_alone_at(method, sums, i);
  if (!pair) return {};
  const auto& normal = method.contacts.normal(static_cast<int>(pair->first), static_cast<int>(pair->second));
  return std::holds_alternative<components::RegressionNormal>(normal) ? pair : std::nullopt;
}

template <int D>
bool any_plane(const GridView<const ContactPlane<D>>& planes)
{
  bool any = false;
  for_each(planes.box(), [&](const Index& i) { any |= planes[i].side != 0; });
  return any;
}

template <int D>
runtime::TaskDeclaration lay_planes(const Method<D>& method)
{
  return runtime::task("lay contact planes")
      .over_patches()
      .sparse(runtime::Sparsity::no_pair)
      .reads(node::sums<D>.halo(method.halo).every_group())
      .computes(node::contact_plane<D>.halo(method.halo).every_group())
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto planes = data[node::contact_plane<D>];
        for_each(sums[0].box(), [&](const Index& i) {
          for (const GridView<ContactPlane<D>>& plane : planes) plane[i] = {};
          if (const auto pair = pair_at(method, sums, i)) {
            planes[pair->first][i].side = -1;
            planes[pair->second][i].side = 1;
          }
        });
        spread_planes(method, at, planes);
      });
}

/// A pass over the particles that adds to the sums of nodes with a plane, as `add(interpolation, block, places,
/// planes, sums)` does.
template <int D, class Label, class Add>
runtime::TaskDeclaration sum_at_planes(const Method<D>& method, std::string name, const Label& label, Add add)
{
  return runtime::task(std::move(name))
      .over_patches_and_groups()
      .sparse(runtime::Sparsity::no_fields)
      .reads(node::contact_plane<D>.halo(method.halo), particle::position<D>.previous(),
             particle::deformation_gradient<D>.previous())
      .accumulates(label.anew().halo(method.halo))
      .body([&method, &label, add](const TaskContext& at, auto data) {
        const auto planes = data[node::contact_plane<D>];
        const auto sums = data[label];
        if (!any_plane(planes)) return;
        add(method.interpolation(at.group), block_of<D>(at.layout, planes), places_at_start<D>(data), planes.data(),
            sums.data());
        fold_images(method, at, sums, true);
      });
}

template <int D>
runtime::TaskDeclaration turn_planes(const Method<D>& method, std::string name)
{
  return runtime::task(std::move(name))
      .over_patches()
      .sparse()
      .reads(node::regression_sums<D>.halo(method.halo).every_group())
      .updates(node::contact_plane<D>.halo(method.halo).every_group())
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::regression_sums<D>];
        const auto planes = data[node::contact_plane<D>];
        for_each(planes[0].box(), [&](const Index& i) {
          const auto pair = parted_at(planes, i);
          if (!pair) return;
          const auto& [first, second] = *pair;
          // Beyond a mirror nothing may have come; such nodes take the plane of their mirror node.
          if (!(sums[first][i].weight() > 0 && sums[second][i].weight() > 0)) return;
          planes[first][i].coefficients = planes[second][i].coefficients =
              components::newton_step<D>(planes[first][i].coefficients, sums[first][i], sums[second][i]);
        });
        mirror_planes(method, at, planes);
      });
}

/// Where two materials face each other along the normal of a plane, as long as the surfaces of both, and what would be
/// left of the gap between them.
template <int D>
runtime::TaskDeclaration find_contact_faces(const Method<D>& method)
{
  return runtime::task("find contact faces")
      .over_patches()
      .sparse(runtime::Sparsity::no_pair)
      .reads(node::contact_plane<D>.halo(method.halo).every_group(), node::edge_sums<D>.halo(method.halo).every_group(),
             node::motion<D>.halo(method.halo).every_group(), node::sums<D>.halo(method.halo).every_group())
      .computes(node::contact_face<D>.halo(method.halo).every_group())
      .body([&method](const TaskContext& at, auto data) {
        const auto planes = data[node::contact_plane<D>];
        const auto edges = data[node::edge_sums<D>];
        const auto motions = data[node::motion<D>];
        const auto sums = data[node::sums<D>];
        const auto faces = data[node::contact_face<D>];
        const auto edge = [&](std::size_t g, const Index& i) { return edge_at<D>(method, g, edges[g][i]); };
        for_each(planes[0].box(), [&](const Index& i) {
          for (const GridView<ContactFace<D>>& face : faces) face[i] = {};
          const auto pair = parted_at(planes, i);
          if (!pair) return;
          const auto& [a, b] = *pair;
          if (!(edges[a][i].weight > 0 && edges[b][i].weight > 0)) return;
          const Vector<D> normal = planes[a][i].normal();
          const double approach = (motions[a][i].velocity() - motions[b][i].velocity()).dot(normal);
          const double gap = -(edge(a, i) + edge(b, i)) - at.step.size * approach;
          const double length = std::max(sums[a][i].surface_gradient().norm(), sums[b][i].surface_gradient().norm());
          faces[a][i] = {2 * (length * normal), gap};
          faces[b][i] = {-2 * (length * normal), gap};
        });
      });
}

}  // namespace

template <int D>
runtime::TaskDeclaration find_edges(const Method<D>& method)
{
  const auto find = [](const auto&... all) { components::add_edges<D>(all...); };
  return sum_at_planes(method, "find edges", node::edge_sums<D>, find);
}

template <int D>
runtime::TaskList contact_planes(const Method<D>& method)
{
  if (!method.contacts.finds_faces()) return {};
  const auto regress = [](const auto&... all) { components::add_regression<D>(all...); };
  return {lay_planes(method),
          sum_at_planes(method, "regress contact 1", node::regression_sums<D>, regress),
          turn_planes(method, "turn contact planes 1"),
          sum_at_planes(method, "regress contact 2", node::regression_sums<D>, regress),
          turn_planes(method, "turn contact planes 2"),
          find_edges(method),
          find_contact_faces(method)};
}

template runtime::TaskDeclaration find_edges(const Method<2>&);
template runtime::TaskDeclaration find_edges(const Method<3>&);
template runtime::TaskList contact_planes(const Method<2>&);
template runtime::TaskList contact_planes(const Method<3>&);

}  // namespace tamp::tasks
