#include "components/materials/mohr_coulomb.hpp"

#include "components/materials/constant_soil.hpp"
#include "components/materials/mohr_coulomb_return.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// The response of a Mohr-Coulomb soil, see SoilBatch.
class MohrCoulombResponse
{
 public:
  explicit MohrCoulombResponse(const MohrCoulomb& soil)
      : soil_(soil),
        sin_friction_(portable::sin(in_radians(soil.friction_angle))),
        sin_dilation_(portable::sin(in_radians(soil.dilation_angle))),
        cohesion_(2 * soil.cohesion * portable::cos(in_radians(soil.friction_angle))),
        tension_(std::min(soil.tension_cutoff, soil.apex_tension()))
  {
  }

  template <int D>
  SoilTrial<D> trial(const SymmetricTensor<D, Lanes>& old, const SymmetricTensor<D, Lanes>& strain,
                     const SoilStateOf<Lanes>& /*state*/) const
  {
    return linear_trial<D>(soil_.initial_moduli(), old, strain);
  }

  template <int D>
  SoilReturn<D> returned(const SoilTrial<D>& trial, const SoilStateOf<Lanes>& state) const
  {
    const Mask<Lanes> widens = -state.plastic_volumetric < soil_.dilation_limit;
    return returned_to<D>({sin_friction_, select(widens, Lanes(sin_dilation_), Lanes(0.0)), cohesion_, tension_},
                          trial);
  }

  ModuliOf<Lanes> stiffness(const SoilStateOf<Lanes>& /*state*/, const Lanes& /*pressure*/) const
  {
    return {soil_.bulk_modulus, soil_.shear_modulus};
  }

 private:
  const MohrCoulomb& soil_;
  double sin_friction_, sin_dilation_, cohesion_, tension_;
};

}  // namespace

std::span<const Parameter<MohrCoulomb>, 8> MohrCoulomb::parameters()
{
  return constant_soil_parameters<MohrCoulomb>;
}

std::span<const StateColumn<MohrCoulomb>, 2> MohrCoulomb::columns()
{
  return soil_columns<MohrCoulomb>;
}

std::span<const StateExtreme, 3> MohrCoulomb::extremes()
{
  return soil_extremes;
}

double MohrCoulomb::apex_tension() const
{
  const double sine = portable::sin(in_radians(friction_angle)), cosine = portable::cos(in_radians(friction_angle));
  return friction_angle > 0 ? cohesion * cosine / sine : std::numeric_limits<double>::infinity();
}

void MohrCoulomb::check() const
{
  check_constant_soil(*this);
}

SoilState MohrCoulomb::settled_state(const SettledStress& settled) const
{
  check_tension(invariants(settled.stress).pressure, std::min(tension_cutoff, apex_tension()));
  const double angle = in_radians(friction_angle);
  check_is_borne(settled, portable::sin(angle), 2 * cohesion * portable::cos(angle));
  return {};
}

template <int D>
BatchFailure update(const MohrCoulomb& soil, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts)
{
  return SoilBatch<D, MohrCoulombResponse>(MohrCoulombResponse(soil), batch, counts).update();
}

template BatchFailure update<2>(const MohrCoulomb&, const MaterialBatch<2, SoilState>&, UpdateCounts&);
template BatchFailure update<3>(const MohrCoulomb&, const MaterialBatch<3, SoilState>&, UpdateCounts&);

}  // namespace tamp::components
