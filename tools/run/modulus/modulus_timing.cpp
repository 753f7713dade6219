#include "tools/run/modulus/modulus_timing.hpp"

#include "components/moduli/elastic_model.hpp"
#include "tools/system/processor_time.hpp"

namespace tamp::tools::compare
{

namespace
{

/// Enough that reading the clock does not count, and few enough that the slowest model takes a moment.
constexpr std::size_t most_states = 4096;

std::vector<double> thinned(std::span<const double> values)
{
  const std::size_t stride = values.size() / most_states + 1;
  std::vector<double> some;
  for (std::size_t i = 0; i < values.size(); i += stride) some.push_back(values[i]);
  return some;
}

std::span<const double> scalars(const runtime::ParticleBlock& block, const std::string& name)
{
  for (const runtime::Column& column : block.columns) {
    if (column.name == name) return std::get<std::span<const double>>(column.values);
  }
  return {};
}

}  // namespace

ModulusTiming::ModulusTiming(const components::Modulus& modulus, components::ElasticUpdate form,
                             std::span<const double> pressure, std::span<const double> elastic,
                             std::span<const double> plastic)
    : modulus_(modulus),
      form_(form),
      pressure_(thinned(pressure)),
      elastic_(thinned(elastic)),
      plastic_(thinned(plastic)),
      bulk_modulus_(elastic_.size()),
      points_(elastic_.size())
{
}

void ModulusTiming::evaluate()
{
  std::visit(
      [&](const auto& model) {
        if (form_ == components::ElasticUpdate::rate) {
          components::evaluate_rate(model, pressure_, elastic_, plastic_, bulk_modulus_);
        } else {
          components::evaluate(model, elastic_, plastic_, points_);
        }
      },
      modulus_);
}

double ModulusTiming::seconds()
{
  const double start = thread_seconds();
  evaluate();
  return thread_seconds() - start;
}

std::vector<ModulusTiming> modulus_timings(tasks::Simulation& simulation)
{
  const std::vector<runtime::ParticleBlock> blocks = simulation.particle_columns();
  std::vector<ModulusTiming> timings;
  for (std::size_t m = 0; m < blocks.size(); ++m) {
    const auto* sand = std::get_if<components::TabularCap>(&simulation.scene().materials[m].model);
    if (sand == nullptr || blocks[m].n == 0) continue;
    timings.emplace_back(sand->parameters().modulus, sand->parameters().elastic_update, scalars(blocks[m], "p"),
                         scalars(blocks[m], "elastic_volumetric"), scalars(blocks[m], "plastic_volumetric"));
  }
  return timings;
}

double nanoseconds_each(std::vector<ModulusTiming>& timings)
{
  double seconds = 0;
  double states = 0;
  for (ModulusTiming& timing : timings) {
    seconds += timing.seconds();
    states += static_cast<double>(timing.n_states());
  }
  return states > 0 ? seconds / states * 1e9 : 0;
}

}  // namespace tamp::tools::compare
