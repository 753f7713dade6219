#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "components/loads/settled_stress.hpp"
#include "components/materials/settled_start.hpp"
#include "components/tensors.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The types of material whose bodies may start settled.
std::vector<std::string_view> settling_types();

/// Whether bodies of both materials start settled, so that one lies on the other.
bool are_strata(const Scene& scene, int material_a, int material_b);

/// A box of ground that has settled under gravity and the centrifuge: at rest from the start, on every node to round-
/// off. Its sides lie on mirroring walls. Along the vertical it lies on its floor or on other such boxes and may carry
/// more of them, each of its own material; together they reach from a mirroring wall to a free top, and each bears the
/// weight above. Across, the stress is k0 times that, and with it what balances the axis' own body force between its
/// two walls.
template <int D>
class SettledGround
{
 public:
  /// Throws components::BadValue for a material that may not start settled, for bodies that are no such boxes, and for
  /// a body force whose component along an axis is not a function of the place on that axis alone. `scene` and `body`
  /// must outlive this object.
  SettledGround(const Scene& scene, const SceneBody& body);

  /// The settled stress of the particle at x.
  components::SettledStress at(const Vector<D>& x) const;
  /// Throws components::BadValue where the stress at x is more than the material can bear.
  void check_at(const Vector<D>& x) const;

  /// The greatest tangent bulk modulus of a particle of the layers, where the sides press most [Pa].
  double greatest_bulk_modulus() const;

 private:
  using Layer = std::array<std::size_t, std::size_t{D}>;

  components::SettledStress stress(const Layer& layer) const;

  const MaterialModel* model_;
  double k0_;
  std::size_t vertical_ = 0;
  /// The layers of the body along each axis.
  std::array<components::LayerColumn, std::size_t{D}> columns_;
  /// For each axis, the stress in each layer that carries the body force along it [Pa, tension positive].
  std::array<std::vector<double>, std::size_t{D}> along_;
};

}  // namespace tamp::tasks
