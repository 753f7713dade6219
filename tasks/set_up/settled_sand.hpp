#pragma once

#include <array>
#include <vector>

#include "components/loads/settled_stress.hpp"
#include "components/materials/tabular_cap.hpp"
#include "components/tensors.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// A box of sand that has settled under gravity and the centrifuge: at rest from the start, on every node to round-off.
/// Its sides lie on mirroring walls, its floor too, and its top is free. Along the vertical the stress carries the
/// weight above. Across, it is nu/(1-nu) of that, as in an elastic layer that cannot widen, and with it what balances
/// the axis' own body force between its two walls. The sand has been loaded to the weight it carries, and not more: its
/// crush pressure is at least the vertical stress.
template <int D>
class SettledSand
{
 public:
  /// Throws components::BadValue for another material or region, and for a body force whose component along an axis is
  /// not a function of the place on that axis alone. `scene` and `body` must outlive this object.
  SettledSand(const Scene& scene, const SceneBody& body);

  struct Particle {
    SymmetricTensor<D> stress;
    components::CapState state;
  };
  /// Stress and state of the particle at x. Throws components::BadValue where the stress is more than the sand can
  /// bear.
  Particle at(const Vector<D>& x) const;

  /// The greatest tangent bulk modulus of a particle of the layers, where the sides press most [Pa].
  double greatest_bulk_modulus() const;

 private:
  SymmetricTensor<D> stress(const std::array<std::size_t, std::size_t{D}>& layer) const;
  Particle settled(const SymmetricTensor<D>& stress) const;

  const components::TabularCap* sand_;
  std::size_t vertical_ = 0;
  std::array<components::LayerColumn, std::size_t{D}> columns_;
  /// For each axis, the stress in each layer that carries the body force along it [Pa, tension positive].
  std::array<std::vector<double>, std::size_t{D}> along_;
};

}  // namespace tamp::tasks
