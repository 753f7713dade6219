#pragma once

#include <variant>

#include "components/anti_locking/cell_average.hpp"
#include "components/tensors.hpp"
#include "runtime/data/views.hpp"
#include "tasks/cells.hpp"
#include "tasks/scene.hpp"

/// Flaws of single particles: monitors sum them up, and field files show where they are.
namespace tamp::tasks
{

/// Compression positive.
template <int D>
double pressure_of(const SymmetricTensor<D>& stress)
{
  return -trace(stress) / 3;
}

/// Sets `cells`, which are those of the patch, to the mean pressures of the particles in them.
template <int D, class Positions, class Volumes, class Stresses>
void average_pressures(const runtime::Grid& grid, const Positions& position, const Volumes& volume,
                       const Stresses& stress, const runtime::GridView<components::CellMean>& cells)
{
  for_each(cells.box(), [&](const runtime::Index& i) { cells[i] = {}; });
  for (std::size_t p = 0; p < volume.size(); ++p) {
    cells[cell_of<D>(grid, cells.box(), position[p])].add(volume[p], pressure_of<D>(stress[p]));
  }
}

/// Neighbours along an axis of the undeformed body that are so many cells apart meet at no node [cells].
inline constexpr double torn_at = 1.2;

/// Tells which particles of a material are torn from their neighbours, and pulled all the same.
class Tearing
{
 public:
  Tearing(const Scene& scene, int material) : stretch_(torn_at * scene.particles_per_axis_of(material)) {}

  template <int D>
  bool operator()(const Matrix<D>& gradient, const SymmetricTensor<D>& stress) const
  {
    return gradient.colwise().norm().maxCoeff() > stretch_ && pressure_of<D>(stress) < 0;
  }

 private:
  double stretch_;
};

/// In matter that flows, neighbours change; and domains that deform with their particles stay together.
inline bool may_tear(const Scene& scene, int material)
{
  const bool deforms = components::with_shape<1>(scene.interpolator, 1, [](const auto& s) { return s.deforms; });
  const MaterialModel& model = scene.materials[static_cast<std::size_t>(material)].model;
  return !deforms && std::visit([]<class Model>(const Model&) { return !components::has_state<Model>; }, model);
}

/// Materials that tell where a state lies beside what was tested.
template <class Model>
concept HasRange = components::has_state<Model> &&
    requires(const Model& model, const typename Model::State& state, double pressure)
{
  {
    model.tested(state, pressure)
    } -> std::same_as<components::Tested>;
};

}  // namespace tamp::tasks
