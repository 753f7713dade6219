#pragma once

#include <vector>

#include "components/materials/tabular_cap.hpp"
#include "tasks/simulation.hpp"

namespace tamp::tools::compare
{

/// States of one sand, to evaluate its elastic model on. The model has to outlive this.
class ModulusTiming
{
 public:
  /// The form that the sand's update uses; `pressure` is compression positive; spans of equal length.
  ModulusTiming(const components::Modulus& modulus, components::ElasticUpdate form, std::span<const double> pressure,
                std::span<const double> elastic, std::span<const double> plastic);

  /// Evaluates the model once on every state, in lanes as the update does.
  void evaluate();
  /// The processor time that this takes [s].
  double seconds();
  std::size_t n_states() const { return elastic_.size(); }

 private:
  const components::Modulus& modulus_;
  components::ElasticUpdate form_;
  std::vector<double> pressure_, elastic_, plastic_;
  std::vector<double> bulk_modulus_;
  std::vector<components::ElasticPoint> points_;
};

/// The states of a simulation's sands now; of many particles some thousands, evenly chosen.
std::vector<ModulusTiming> modulus_timings(tasks::Simulation& simulation);

/// Time of one evaluation, the mean over all states [ns].
double nanoseconds_each(std::vector<ModulusTiming>& timings);

}  // namespace tamp::tools::compare
