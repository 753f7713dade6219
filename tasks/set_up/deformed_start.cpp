#include "tasks/set_up/deformed_start.hpp"

#include <algorithm>
#include <stdexcept>

#include "tasks/method.hpp"
#include "tasks/set_up/body_sites.hpp"

namespace tamp::tasks
{

namespace
{

/// The material's answer to a deformation without a past.
template <int D, class Model>
DeformedStart<D> answer_of(const Model& model, const Matrix<D>& f)
{
  if constexpr (components::Hyperelastic<Model>) {
    DeformedStart<D> start{f, f.determinant(), SymmetricTensor<D>::Zero(), model.template stored_energy<D>(f), {}};
    const SymmetricTensor<D> no_increment = SymmetricTensor<D>::Zero();
    double plastic_work = 0;
    components::UpdateCounts counts;
    update(model,
           components::MaterialBatch<D, components::NoState>{.strain_increment = {&no_increment, 1},
                                                             .deformation_gradient = {&f, 1},
                                                             .old_state = {},
                                                             .stress = {&start.stress, 1},
                                                             .state = {},
                                                             .bulk_modulus = {&start.moduli.bulk_modulus, 1},
                                                             .shear_modulus = {&start.moduli.shear_modulus, 1},
                                                             .plastic_work = {&plastic_work, 1}},
           counts);
    return start;
  } else {
    throw std::logic_error("a material whose stress has a past starts deformed");
  }
}

/// The part of a deformation in space that lies in the plane of the first D axes.
template <int D>
DeformedStart<D> in_plane(const DeformedStart<3>& start)
{
  return {start.deformation_gradient.template topLeftCorner<D, D>(), start.volume_ratio,
          start.stress.template head<n_symmetric<D>>(), start.stored_energy, start.moduli};
}

}  // namespace

bool may_start_deformed(const MaterialModel& model)
{
  return std::visit([]<class Model>(const Model&) { return components::Hyperelastic<Model>; }, model);
}

template <int D>
DeformedStart<D> deformed_start(const Scene& scene, const SceneBody& body, const Vector<D>& X)
{
  const Matrix<3> f = body.functions.deformation_gradient(in_space<D>(X));
  return std::visit(
      [&](const auto& model) {
        if (scene.axisymmetric) return in_plane<D>(answer_of<3>(model, f));
        return answer_of<D>(model, Matrix<D>(f.template topLeftCorner<D, D>()));
      },
      scene.materials[static_cast<std::size_t>(body.material)].model);
}

template <int D>
components::TangentModuli greatest_deformed_moduli(const Scene& scene, const SceneBody& body)
{
  components::TangentModuli greatest{0, 0};
  for (const components::Site<D>& site : particle_sites<D>(scene, body)) {
    const DeformedStart<D> start = deformed_start<D>(scene, body, site.place);
    const double J = start.volume_ratio;
    greatest.bulk_modulus = std::max(greatest.bulk_modulus, J * start.moduli.bulk_modulus);
    greatest.shear_modulus = std::max(greatest.shear_modulus, J * start.moduli.shear_modulus);
  }
  return greatest;
}

template DeformedStart<2> deformed_start(const Scene&, const SceneBody&, const Vector<2>&);
template DeformedStart<3> deformed_start(const Scene&, const SceneBody&, const Vector<3>&);
template components::TangentModuli greatest_deformed_moduli<2>(const Scene&, const SceneBody&);
template components::TangentModuli greatest_deformed_moduli<3>(const Scene&, const SceneBody&);

}  // namespace tamp::tasks
