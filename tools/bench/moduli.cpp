#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <random>

#include "components/moduli/modulus_surface.hpp"
#include "components/moduli/network_modulus.hpp"
#include "components/moduli/support_vector_modulus.hpp"
#include "components/moduli/unloading_table.hpp"
#include "tools/bench/bench.hpp"
#include "tools/bench/plain_moduli.hpp"
#include "tools/scene/read_network.hpp"
#include "tools/scene/read_support_vectors.hpp"
#include "tools/scene/unloading_curves.hpp"
#include "tools/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

using components::ElasticPoint;
using components::ModulusSurface;
using components::NetworkModulus;
using components::SupportVectorModulus;
using components::UnloadingTable;

constexpr std::size_t n_states = 4096;
constexpr int moduli_rounds = 15;
constexpr double least_seconds = 2e-3;  // of one measurement

struct States {
  std::vector<double> elastic, plastic;
};

/// In compression, where the tests measured.
States states_of(const UnloadingTable& table)
{
  const components::StrainRange range = table.range();
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> elastic(0, range.most_elastic);
  std::uniform_real_distribution<double> plastic(range.least_plastic, range.most_plastic);
  States states;
  while (states.elastic.size() < n_states) {
    const double e = elastic(random), ep = plastic(random);
    if (!table.in_range(e, ep)) continue;
    states.elastic.push_back(e);
    states.plastic.push_back(ep);
  }
  return states;
}

using Points = std::vector<ElasticPoint>;
using EvaluationLoop = std::function<void(const States&, Points&)>;

template <components::ElasticModel Model>
EvaluationLoop batch_of(const Model& model)
{
  return [&model](const States& states, Points& points) {
    components::evaluate(model, std::span(states.elastic), std::span(states.plastic), std::span(points));
  };
}

template <class Function>
EvaluationLoop loop_of(const Function& point_at)
{
  return [point_at](const States& states, Points& points) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = point_at(states.elastic[i], states.plastic[i]);
  };
}

/// Processor time of this thread [s]: what others do on the machine does not count.
double seconds_now()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Nanoseconds a state.
double measured(const EvaluationLoop& loop, const States& states, Points& points)
{
  const double start = seconds_now();
  double seconds = 0;
  int n = 0;
  while (seconds < least_seconds) {
    loop(states, points);
    ++n;
    seconds = seconds_now() - start;
  }
  return seconds / n / static_cast<double>(points.size()) * 1e9;
}

/// One model: as it is used, and by its definition.
struct Contest {
  std::string model;
  EvaluationLoop batch, plain;
  std::vector<double> batch_ns{}, plain_ns{};
  double max_error = 0;

  void measure(const States& states)
  {
    Points points(n_states), expected(n_states);
    batch_ns.push_back(measured(batch, states, points));
    plain_ns.push_back(measured(plain, states, expected));
    max_error = std::max(error(points, expected, &ElasticPoint::pressure),
                         error(points, expected, &ElasticPoint::bulk_modulus));
  }

  /// The largest difference, of the largest number. A loop that has no pressure leaves it at none.
  static double error(const Points& points, const Points& expected, double ElasticPoint::*member)
  {
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::isnan(expected[i].*member)) continue;
      difference = std::max(difference, std::abs(points[i].*member - expected[i].*member));
      largest = std::max(largest, std::abs(expected[i].*member));
    }
    return largest > 0 ? difference / largest : 0;
  }
};

Result result_of(const std::vector<Contest>& contests)
{
  Result result;
  result.json = nlohmann::ordered_json::array();
  result.text =
      fmt::format("moduli: p and K of {} states, median of {} rounds\n  {:<14}{:>10}{:>12}{:>14}{:>12}{:>12}\n",
                  n_states, moduli_rounds, "model", "batch ns", "plain ns", "plain/batch", "of table", "max error");
  const double table_ns = median(contests.front().batch_ns);
  for (const Contest& contest : contests) {
    const double batch_ns = median(contest.batch_ns), plain_ns = median(contest.plain_ns);
    result.json.push_back(
        {{"model", contest.model}, {"batch_ns", batch_ns}, {"scalar_ns", plain_ns}, {"max_error", contest.max_error}});
    result.text += fmt::format("  {:<14}{:>10.1f}{:>12.1f}{:>14.1f}{:>12.2f}{:>12.1e}\n", contest.model, batch_ns,
                               plain_ns, plain_ns / batch_ns, batch_ns / table_ns, contest.max_error);
  }
  return result;
}

}  // namespace

Result moduli(const std::filesystem::path& material)
{
  const Table curves = read_unloading_curves(material / "unloading.csv", StrainMeasure::logarithmic);
  const UnloadingTable table(curves.columns[0], curves.columns[1], curves.columns[2]);
  const components::SupportVectorFit vectors = read_support_vectors(material / "support_vectors.json");
  const SupportVectorModulus svr(vectors, components::ZeroPressure::as_fitted);
  NetworkFile file = read_network_file(material / "network.h5");
  const components::NetworkFit network = network_fit(std::move(file.layers), file.scaling.value(), file.range.value());
  const NetworkModulus mlp(network);
  const ModulusSurface compiled_svr(svr, 1e-4), compiled_mlp(mlp, 1e-2);

  const EvaluationLoop plain_table = loop_of([&](double e, double ep) { return table.defined_at(e, ep); });
  const EvaluationLoop plain_svr = loop_of([&](double e, double ep) { return plain_support_vectors(vectors, e, ep); });
  const EvaluationLoop plain_mlp = loop_of([&](double e, double ep) {
    return ElasticPoint{std::numeric_limits<double>::quiet_NaN(), plain_network(network, e, ep), 0};
  });
  std::vector<Contest> contests{{"table", batch_of(table), plain_table},
                                {"svr", batch_of(svr), plain_svr},
                                {"mlp", batch_of(mlp), plain_mlp},
                                {"compiled svr", batch_of(compiled_svr), plain_svr},
                                {"compiled mlp", batch_of(compiled_mlp), plain_mlp}};

  const States states = states_of(table);
  for (int round = 0; round < moduli_rounds; ++round) {
    for (Contest& contest : contests) contest.measure(states);
  }
  return result_of(contests);
}

}  // namespace tamp::tools::bench
