#include "tools/run/drive/drive_costs.hpp"

#include <algorithm>

#include "components/kinematics/strain_increment.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools
{

namespace
{

/// As many particles as a run takes to the material at once.
constexpr std::size_t n_of_batch = 256;

/// The updates of a path as a batch of particles.
template <class Model>
class RecordedUpdates
{
 public:
  RecordedUpdates(const Model& model, std::span<const MaterialPoint> points) : model_(model)
  {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) add(points[i], points[i + 1]);
    const std::size_t n = std::min(n_of_batch, size());
    stress_.resize(n);
    state_.resize(n);
    opening_.resize(n);
    bulk_modulus_.resize(n);
    shear_modulus_.resize(n);
    plastic_work_.resize(n);
  }

  std::size_t size() const { return old_stress_.size(); }

  /// Makes all of them; what that takes.
  components::UpdateCounts update()
  {
    components::UpdateCounts counts;
    for (std::size_t first = 0; first < size(); first += n_of_batch) {
      update(first, std::min(n_of_batch, size() - first), counts);
    }
    return counts;
  }

 private:
  using State = typename Model::State;

  void add(const MaterialPoint& from, const MaterialPoint& to)
  {
    const Matrix<3> gradient = to.deformation_gradient * from.deformation_gradient.inverse() - Matrix<3>::Identity();
    const auto step = components::strain_increment<3>(from.deformation_gradient, gradient);
    strain_.push_back(step.strain_increment);
    deformation_gradient_.push_back(to.deformation_gradient);
    old_stress_.push_back(rotated<3>(from.stress, step.rotation_increment));
    old_state_.push_back(std::any_cast<const State&>(from.state));
    old_opening_.push_back(from.opening);
  }

  void update(std::size_t first, std::size_t n, components::UpdateCounts& counts)
  {
    const auto part = [first, n](const auto& values) { return std::span(values).subspan(first, n); };
    const auto room = [n](auto& values) { return std::span(values).first(n); };
    std::ranges::copy(part(old_stress_), stress_.begin());
    components::MaterialBatch<3, State> batch{.strain_increment = part(strain_),
                                              .deformation_gradient = part(deformation_gradient_),
                                              .old_state = part(old_state_),
                                              .stress = room(stress_),
                                              .state = room(state_),
                                              .bulk_modulus = room(bulk_modulus_),
                                              .shear_modulus = room(shear_modulus_),
                                              .plastic_work = room(plastic_work_)};
    if (components::keeps_gaps(model_)) {
      batch.old_opening = part(old_opening_);
      batch.opening = room(opening_);
    }
    // None fails here that did not fail in the drive.
    components::update(model_, batch, counts);
  }

  const Model& model_;
  std::vector<SymmetricTensor<3>> strain_, old_stress_;
  std::vector<Matrix<3>> deformation_gradient_;
  std::vector<State> old_state_;
  std::vector<double> old_opening_;
  // Data of one batch.
  std::vector<SymmetricTensor<3>> stress_;
  std::vector<State> state_;
  std::vector<double> opening_, bulk_modulus_, shear_modulus_, plastic_work_;
};

}  // namespace

DriveCosts drive_costs(const tasks::MaterialModel& material, std::span<const MaterialPoint> points, int n_rounds)
{
  return std::visit(
      [&](const auto& model) {
        RecordedUpdates updates(model, points);
        std::vector<double> seconds;
        seconds.reserve(static_cast<std::size_t>(n_rounds));
        for (int round = 0; round < n_rounds; ++round) seconds.push_back(seconds_of([&] { updates.update(); }));
        const double ns_per_update = median(seconds) / static_cast<double>(updates.size()) * 1e9;
        return DriveCosts{updates.size(), updates.update(), ns_per_update};
      },
      material);
}

}  // namespace tamp::tools
