#pragma once

#include <array>
#include <cmath>
#include <span>

#include "components/contact/friction.hpp"
#include "components/portable_math.hpp"
#include "components/shapes/node_sums.hpp"
#include "runtime/data/views.hpp"
#include "tasks/method.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

template <int D>
components::ContactThresholds contact_thresholds(const Method<D>& method)
{
  return {method.least_node_mass, 1e-9 * portable::pow(method.cell_size, method.axisymmetric ? 2 : D - 1)};
}

/// The materials at one node, side by side.
template <int D>
struct NodeOfMaterials {
  static constexpr int max_groups = runtime::PerGroup<int>::max_groups;

  std::array<double, max_groups> mass;
  std::array<Vector<D>, max_groups> surface_gradient;
  std::array<Vector<D>, max_groups> velocity;
  std::array<components::ContactFace<D>, max_groups> face;

  /// Whether at least two of the groups have mass here: only then all of them are gathered. `faces` are none where no
  /// contact finds any.
  template <class Motions>
  bool gather(const Method<D>& method, const runtime::PerGroup<runtime::GridView<const components::NodeSums<D>>>& sums,
              const Motions& motions,
              const runtime::PerGroup<runtime::GridView<const components::ContactFace<D>>>& faces,
              const runtime::Index& i)
  {
    n_groups_ = sums.size();
    has_faces_ = faces.size() > 0;
    int n_present = 0;
    for (std::size_t g = 0; g < sums.size(); ++g) {
      mass[g] = sums[g][i].mass();
      if (mass[g] > method.least_node_mass) ++n_present;
    }
    if (n_present < 2) return false;
    for (std::size_t g = 0; g < sums.size(); ++g) {
      surface_gradient[g] = sums[g][i].surface_gradient();
      velocity[g] = motions[g][i].velocity();
      if (has_faces_) face[g] = faces[g][i];
    }
    return true;
  }

  components::NodeSurfaces<D> surfaces() const
  {
    return {std::span(surface_gradient.data(), n_groups_), std::span(face.data(), has_faces_ ? n_groups_ : 0)};
  }

  /// The rigid body here, or null. Throws SimulationError where two meet, whose impulse no node can tell.
  const RigidBody* rigid_body(const Method<D>& method, const RigidStates& states) const
  {
    const RigidBody* found = nullptr;
    for (const RigidBody& body : method.rigid_bodies) {
      if (!(mass[static_cast<std::size_t>(body.material)] > method.least_node_mass)) continue;
      if (found != nullptr) {
        const Eigen::Vector3d& centre = states.of(body).centre;
        throw SimulationError("two rigid bodies meet; one of them must be deformable",
                              method.materials[static_cast<std::size_t>(body.material)].name, -1,
                              {centre.begin(), centre.begin() + D});
      }
      found = &body;
    }
    return found;
  }

 private:
  std::size_t n_groups_ = 0;
  bool has_faces_ = false;
};

}  // namespace tamp::tasks
