#pragma once

#include "components/materials/principal_stresses.hpp"
#include "components/materials/soil_update.hpp"

namespace tamp::components
{

/// Mohr and Coulomb's strength of each lane. With principal stresses s1 >= s2 >= s3, tension positive,
///
///     (s1 - s3) + (s1 + s3) sin(phi) <= 2 c cos(phi),
///
/// and a mean tension that is at most `tension`. Flow follows the gradient of (s1 - s3) + (s1 + s3) sin(psi).
struct MohrCoulombStrength {
  Lanes sin_friction;
  Lanes sin_dilation;  ///< negative where shear compacts
  Lanes cohesion;      ///< 2 c cos(phi) [Pa]
  Lanes tension;       ///< at most that of the apex [Pa]

  /// Amount by which two principal stresses exceed the strength [Pa].
  Lanes beyond(const Lanes& greater, const Lanes& lesser) const
  {
    return (greater - lesser) + (greater + lesser) * sin_friction - cohesion;
  }
};

/// The return in principal stresses, in closed form: to the plane, the edge of two equal greater or lesser ones, or the
/// cut-off (J. Clausen, L. Damkilde and L. Andersen, Int. J. Numer. Meth. Eng. 66, 2006; E. A. de Souza Neto, D. Peric
/// and D. R. J. Owen, Computational Methods for Plasticity, Wiley 2008, section 8.2).
class MohrCoulombReturn
{
 public:
  MohrCoulombReturn(const MohrCoulombStrength& strength, const ModuliOf<Lanes>& moduli)
      : strength_(strength),
        up_(2.0 * moduli.shear_modulus * (1.0 + strength.sin_dilation)),
        down_(2.0 * moduli.shear_modulus * (1.0 - strength.sin_dilation)),
        all_(2.0 * lame(moduli) * strength.sin_dilation),
        lame_(2.0 * all_ * strength.sin_friction)
  {
  }

  PrincipalValues<Lanes> operator()(const PrincipalValues<Lanes>& trial) const
  {
    const auto& [s1, s2, s3] = trial;
    const Lanes beyond = strength_.beyond(s1, s3);
    const Mask<Lanes> is_elastic = beyond <= 0.0;
    const Lanes own = (1.0 + strength_.sin_friction) * up_ + (1.0 - strength_.sin_friction) * down_ + lame_;
    const Lanes flow = beyond / own;
    const PrincipalValues<Lanes> on_plane{s1 - flow * (up_ + all_), s2 - flow * all_, s3 + flow * (down_ - all_)};
    // Which two meet first on the way along the flow.
    const Mask<Lanes> upper_meet = (s1 - s2) * down_ < (s2 - s3) * up_;
    const Mask<Lanes> in_order = on_plane[0] >= on_plane[1] && on_plane[1] >= on_plane[2];
    const PrincipalValues<Lanes> edge = on_edge(trial, beyond, own, upper_meet);
    PrincipalValues<Lanes> now;
    for (std::size_t k = 0; k < 3; ++k) {
      now[k] = select(is_elastic, trial[k], select(in_order, on_plane[k], edge[k]));
    }
    return now;
  }

  /// Returns trial values to the cut-off: the mean stress is at the cut-off, with as much of the deviator as the
  /// strength allows there.
  PrincipalValues<Lanes> at_cut_off(const PrincipalValues<Lanes>& values) const
  {
    const Lanes mean = (values[0] + values[1] + values[2]) / 3.0;
    const Lanes shear = strength_.beyond(values[0] - mean, values[2] - mean) + strength_.cohesion;
    const Lanes left = greater_of<Lanes>(strength_.cohesion - 2.0 * strength_.sin_friction * strength_.tension, 0.0);
    const Lanes part = select(shear > left, left / select(shear > left, shear, Lanes(1.0)), Lanes(1.0));
    PrincipalValues<Lanes> now;
    for (std::size_t k = 0; k < 3; ++k) now[k] = strength_.tension + part * (values[k] - mean);
    return now;
  }

 private:
  static Lanes lame(const ModuliOf<Lanes>& m) { return m.bulk_modulus - 2.0 / 3.0 * m.shear_modulus; }

  /// Returns to two planes at once: the first with the greatest and the least stress, the second with the stress that
  /// has met another in place of that.
  PrincipalValues<Lanes> on_edge(const PrincipalValues<Lanes>& trial, const Lanes& beyond, const Lanes& own,
                                 const Mask<Lanes>& upper_meet) const
  {
    const auto& [s1, s2, s3] = trial;
    const Lanes second = select(upper_meet, strength_.beyond(s2, s3), strength_.beyond(s1, s2));
    const Lanes between =
        select(upper_meet, (1.0 - strength_.sin_friction) * down_, (1.0 + strength_.sin_friction) * up_) + lame_;
    const Lanes divisor = own * own - between * between;
    const Lanes a = (own * beyond - between * second) / divisor, b = (own * second - between * beyond) / divisor;
    const Lanes sum = a + b;
    return {s1 - select(upper_meet, a, sum) * up_ - sum * all_, s2 + b * select(upper_meet, -up_, down_) - sum * all_,
            s3 + select(upper_meet, sum, a) * down_ - sum * all_};
  }

  const MohrCoulombStrength& strength_;
  /// Amounts that a unit of flow takes from the greatest stress, gives the least, and takes from all.
  Lanes up_, down_, all_;
  Lanes lame_;
};

/// The return of stresses, and the flow that goes with it.
template <int D>
SoilReturn<D> returned_to(const MohrCoulombStrength& strength, const SoilTrial<D>& trial)
{
  const Principal<D, Lanes> axes(trial.stress);
  const PrincipalValues<Lanes> from = axes.values();
  const MohrCoulombReturn return_of(strength, trial.moduli);
  PrincipalValues<Lanes> to = return_of(from);
  const Mask<Lanes> is_torn = to[0] + to[1] + to[2] > 3.0 * strength.tension;
  const PrincipalValues<Lanes> cut = return_of.at_cut_off(from);
  for (std::size_t k = 0; k < 3; ++k) to[k] = select(is_torn, cut[k], to[k]);

  const Lanes lost = ((from[0] - to[0]) + (from[1] - to[1]) + (from[2] - to[2])) / 3.0;
  const Lanes expansion = lost / trial.moduli.bulk_modulus;
  const Lanes mean = (to[0] + to[1] + to[2]) / 3.0;
  Lanes squares = 0.0, work = mean * expansion;
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes shear = (from[k] - to[k] - lost) / (2.0 * trial.moduli.shear_modulus);
    squares += shear * shear;
    work += (to[k] - mean) * shear;
  }
  return {axes.with(to), expansion, sqrt(2.0 / 3.0 * squares), work, is_torn};
}

}  // namespace tamp::components
