#include "components/problems/vibrating_bar.hpp"

#include "components/errors.hpp"
#include "components/materials/wave_speed.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// Speed of small waves of compression [m/s].
double elastic_wave_speed(const ProblemBody& body)
{
  const auto speed_in = [&](const auto& solid) {
    return wave_speed(solid.bulk_modulus, solid.shear_modulus, body.density);
  };
  if (const auto* solid = std::get_if<Hypoelastic>(&body.material)) return speed_in(*solid);
  if (const auto* solid = std::get_if<NeoHookean>(&body.material)) return speed_in(*solid);
  if (const auto* solid = std::get_if<NeoHookeanLog>(&body.material)) return speed_in(*solid);
  throw BadValue("a material that is not elastic", "one of type hypoelastic, neo_hookean or neo_hookean_log");
}

}  // namespace

BodyFunctions VibratingBar::functions(const ProblemBody& body) const
{
  const double v = speed, k = wave_number, along = drift, omega = k * elastic_wave_speed(body);
  BodyFunctions bar;
  bar.velocity = [=](const Vector<3>& X) { return Vector<3>(v * portable::sin(k * X[0]) + along, 0, 0); };
  bar.exact_displacement = [=](const Vector<3>& X, double t) {
    return Vector<3>(v / omega * portable::sin(k * X[0]) * portable::sin(omega * t) + along * t, 0, 0);
  };
  return bar;
}

}  // namespace tamp::components
