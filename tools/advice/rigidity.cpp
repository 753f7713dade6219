#include "tools/advice/rigidity.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/set_up/initial_moduli.hpp"

namespace tamp::tools
{

namespace
{

/// `momentum` is what the ground's waves would take at the first speed, over the body's own. They weaken as the ground
/// yields and the body slows down.
double part_of_way_lost(double momentum)
{
  return std::min(1.0, 0.28 * std::pow(momentum, 0.65));
}

}  // namespace

Rigidity rigidity_of(const tasks::Scene& scene, const tasks::SceneBody& body, const Penetration& penetration)
{
  const auto& material = scene.materials[static_cast<std::size_t>(body.material)];
  const auto& ground = scene.materials[static_cast<std::size_t>(penetration.into->material)];
  const double time = scene.time.end, c = tasks::initial_wave_speed(material);
  const double impedance = ground.density * tasks::initial_wave_speed(ground);
  const Eigen::Vector3d way = way_of(scene, body) - way_of(scene, *penetration.into), ahead = way.normalized();
  const double length = reach(body, ahead) + reach(body, -ahead);
  return {.strain = impedance * way.norm() / time / (material.density * c * c),
          .transit = length / (c * time),
          .slowed = part_of_way_lost(impedance * time / (material.density * length)),
          .cells = penetration.cells()};
}

}  // namespace tamp::tools
