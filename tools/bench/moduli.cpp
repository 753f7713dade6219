#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "components/lanes.hpp"
#include "components/moduli/modulus_surface.hpp"
#include "components/moduli/network_modulus.hpp"
#include "components/moduli/support_vector_modulus.hpp"
#include "components/moduli/unloading_table.hpp"
#include "tools/bench/bench.hpp"
#include "tools/bench/peak_rate.hpp"
#include "tools/bench/plain_moduli.hpp"
#include "tools/scene/materials/read_network.hpp"
#include "tools/scene/materials/read_support_vectors.hpp"
#include "tools/scene/materials/unloading_curves.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

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

struct States {
  std::vector<double> pressure, elastic, plastic;
};

/// States in compression, where the tests measured.
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
    states.pressure.push_back(table.at(e, ep).pressure);
    states.elastic.push_back(e);
    states.plastic.push_back(ep);
  }
  return states;
}

using Points = std::vector<ElasticPoint>;
using EvaluationLoop = std::function<void(const States&, Points&)>;

template <class Function>
EvaluationLoop loop_of(const Function& point_at)
{
  return [point_at](const States& states, Points& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = point_at(states.pressure[i], states.elastic[i], states.plastic[i]);
    }
  };
}

/// The state form, for one state after the other, and below for lanes of them.
template <components::ElasticModel Model>
EvaluationLoop single_of(const Model& model)
{
  return loop_of([&model](double, double e, double ep) { return model.at(e, ep); });
}
template <components::ElasticModel Model>
EvaluationLoop batch_of(const Model& model)
{
  return [&model](const States& states, Points& points) {
    components::evaluate(model, std::span(states.elastic), std::span(states.plastic), std::span(points));
  };
}

/// The rate form, which gives K alone.
template <components::ElasticModel Model>
EvaluationLoop single_rate_of(const Model& model)
{
  return loop_of([&model](double p, double e, double ep) { return ElasticPoint{0, model.rate_modulus(p, e, ep), 0}; });
}
template <components::ElasticModel Model>
EvaluationLoop batch_rate_of(const Model& model)
{
  return [&model, moduli = std::vector<double>(n_states)](const States& states, Points& points) mutable {
    components::evaluate_rate(model, std::span(states.pressure), std::span(states.elastic), std::span(states.plastic),
                              std::span(moduli));
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {0, moduli[i], 0};
  };
}

/// Time of an evaluation [ns a state].
double measured(const EvaluationLoop& loop, const States& states, Points& points)
{
  return seconds_of([&] { loop(states, points); }) / static_cast<double>(points.size()) * 1e9;
}

/// A form of a model, as it is used and by its definition. `multiply_adds` is about what one state needs.
struct Contest {
  std::string model, form;
  int multiply_adds;
  EvaluationLoop batch, single, plain;
  std::vector<double> batch_ns{}, single_ns{}, plain_ns{};
  double max_error = 0;

  void measure(const States& states)
  {
    Points points(n_states), expected(n_states);
    single_ns.push_back(measured(single, states, points));
    batch_ns.push_back(measured(batch, states, points));
    plain_ns.push_back(measured(plain, states, expected));
    max_error = error(points, expected, &ElasticPoint::bulk_modulus);
    if (form == "state") max_error = std::max(max_error, error(points, expected, &ElasticPoint::pressure));
  }

  /// The largest difference over the largest number. A loop without pressures leaves them empty.
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

Result result_of(const std::vector<Contest>& contests, double arithmetic_ns)
{
  Result result;
  result.json = nlohmann::ordered_json::array();
  result.text = fmt::format(
      "moduli: {} states, {} at once, median of {} rounds; a multiplication and an addition {:.3f} ns where none "
      "waits\n"
      "  {:<14}{:<6}{:>9}{:>10}{:>10}{:>10}{:>14}{:>10}{:>11}\n",
      n_states, n_lanes, moduli_rounds, arithmetic_ns, "model", "form", "batch ns", "single ns", "plain ns", "of table",
      "multiply-adds", "of bound", "max error");
  for (const Contest& contest : contests) {
    const auto& table = *std::ranges::find(contests, contest.form, &Contest::form);
    const double batch_ns = median(contest.batch_ns), single_ns = median(contest.single_ns);
    const double plain_ns = median(contest.plain_ns), of_bound = batch_ns / (contest.multiply_adds * arithmetic_ns);
    result.json.push_back({{"model", contest.model},
                           {"form", contest.form},
                           {"batch_ns", batch_ns},
                           {"single_ns", single_ns},
                           {"scalar_ns", plain_ns},
                           {"multiply_adds", contest.multiply_adds},
                           {"of_bound", of_bound},
                           {"max_error", contest.max_error}});
    result.text += fmt::format("  {:<14}{:<6}{:>9.1f}{:>10.1f}{:>10.1f}{:>10.2f}{:>14}{:>10.1f}{:>11.1e}\n",
                               contest.model, contest.form, batch_ns, single_ns, plain_ns,
                               batch_ns / median(table.batch_ns), contest.multiply_adds, of_bound, contest.max_error);
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

  const auto plain_table = loop_of([&](double, double e, double ep) { return table.defined_at(e, ep); });
  const auto plain_table_rate = loop_of([&](double p, double e, double ep) {
    return ElasticPoint{0, table.rate_modulus(p, e, ep), 0};
  });
  const auto plain_svr = loop_of([&](double, double e, double ep) { return plain_support_vectors(vectors, e, ep); });
  const auto plain_mlp = loop_of([&](double, double e, double ep) {
    return ElasticPoint{std::numeric_limits<double>::quiet_NaN(), plain_network(network, e, ep), 0};
  });
  // Counted in: polynomials of a tile, neurons that switch, bicubic patches; what finds them is not.
  std::vector<Contest> contests;
  const auto add = [&](const std::string& name, const auto& model, int rate, int state,
                       const EvaluationLoop& plain_rate, const EvaluationLoop& plain) {
    contests.push_back({name, "rate", rate, batch_rate_of(model), single_rate_of(model), plain_rate});
    contests.push_back({name, "state", state, batch_of(model), single_of(model), plain});
  };
  add("table", table, 3, 56, plain_table_rate, plain_table);
  add("svr", svr, 101, 203, plain_svr, plain_svr);
  add("mlp", mlp, 17, 85, plain_mlp, plain_mlp);
  add("compiled svr", compiled_svr, 68, 68, plain_svr, plain_svr);
  add("compiled mlp", compiled_mlp, 68, 68, plain_mlp, plain_mlp);

  const States states = states_of(table);
  const double arithmetic_ns = 2e9 / multiplies_and_adds_per_second();
  for (int round = 0; round < moduli_rounds; ++round) {
    for (Contest& contest : contests) contest.measure(states);
  }
  return result_of(contests, arithmetic_ns);
}

}  // namespace tamp::tools::bench
