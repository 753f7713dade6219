#include "tools/run/modulus/modulus_states.hpp"

#include <fmt/core.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>

#include "tools/run/modulus/modulus_timing.hpp"
#include "tools/scene/tables/csv_table.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools
{

namespace
{

using components::ElasticUpdate;
using components::Modulus;

constexpr char pressure_column[] = "pressure[Pa]";
constexpr char modulus_column[] = "bulk_modulus[Pa]";

bool has_measurements(const std::filesystem::path& file)
{
  return std::ranges::any_of(greatest_of_columns(file), [](const auto& column) {
    return column.first == pressure_column || column.first == modulus_column;
  });
}

/// Errors are relative to these.
void expect_above_zero(const Table& table, std::size_t column, const std::string& name)
{
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    if (table.columns[column][i] > 0) continue;
    throw InputError(table.problem(static_cast<std::ptrdiff_t>(i), fmt::format("{} {}", name, table.columns[column][i]),
                                   "expected a number above 0"));
  }
}

/// dp = K(p, e) de from no elastic strain on, by the classical Runge-Kutta method.
template <class Model>
double integrated_pressure(const Model& model, double elastic, double plastic)
{
  constexpr int n_steps = 1000;
  const double h = elastic / n_steps;
  double p = 0;
  for (int i = 0; i < n_steps; ++i) {
    const double e = h * i;
    const double first = model.rate_modulus(p, e, plastic);
    const double second = model.rate_modulus(p + 0.5 * h * first, e + 0.5 * h, plastic);
    const double third = model.rate_modulus(p + 0.5 * h * second, e + 0.5 * h, plastic);
    const double fourth = model.rate_modulus(p + h * third, e + h, plastic);
    p += h / 6 * (first + 2 * second + 2 * third + fourth);
  }
  return p;
}

/// How far numbers are from measured ones, relative to these.
class RelativeErrors
{
 public:
  /// The error of one more number, and the root mean square of all so far.
  std::string columns(double value, double measured)
  {
    const double error = std::abs(value / measured - 1);
    squares_ += error * error;
    return fmt::format(",{:.17g},{:.17g}", error, std::sqrt(squares_ / ++n_));
  }

 private:
  double squares_ = 0;
  int n_ = 0;
};

/// Bytes that this process has allocated on the heap.
std::size_t heap_bytes()
{
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Bytes of a model with all that it points to, measured as those of a copy.
std::size_t bytes_of(const Modulus& modulus)
{
  return std::visit(
      [](const auto& model) {
        const std::size_t before = heap_bytes();
        const auto copy = model;
        return sizeof(copy) + (heap_bytes() - before);
      },
      modulus);
}

}  // namespace

ModulusStates read_modulus_states(const std::filesystem::path& file)
{
  std::vector<std::string> columns{"elastic_volumetric[-]", "plastic_volumetric[-]"};
  const bool measured = has_measurements(file);
  if (measured) columns.insert(columns.end(), {pressure_column, modulus_column});
  Table table = read_csv_table(file, columns);
  if (!measured) return {std::move(table.columns[0]), std::move(table.columns[1]), {}, {}};
  expect_above_zero(table, 2, pressure_column);
  expect_above_zero(table, 3, modulus_column);
  return {std::move(table.columns[0]), std::move(table.columns[1]), std::move(table.columns[2]),
          std::move(table.columns[3])};
}

ModulusAnswer answer_at(const Modulus& modulus, ElasticUpdate form, double elastic, double plastic)
{
  return std::visit(
      [&](const auto& model) -> ModulusAnswer {
        const double by_plastic = model.modulus_by_plastic(elastic, plastic);
        if (form == ElasticUpdate::state) {
          const components::ElasticPoint point = model.at(elastic, plastic);
          return {point.pressure, point.bulk_modulus, by_plastic, model.in_range(elastic, plastic)};
        }
        const double pressure = integrated_pressure(model, elastic, plastic);
        return {pressure, model.rate_modulus(pressure, elastic, plastic), by_plastic,
                model.rate_in_range(pressure, elastic, plastic)};
      },
      modulus);
}

std::string modulus_header()
{
  return "elastic_v[-],plastic_v[-],p[Pa],K[Pa],G[Pa],dK_dplastic[Pa],in_range";
}

std::string modulus_row(double elastic, double plastic, const ModulusAnswer& answer, double shear_ratio)
{
  return fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:d}", elastic, plastic, answer.pressure,
                     answer.bulk_modulus, shear_ratio * answer.bulk_modulus, answer.modulus_by_plastic,
                     answer.in_range);
}

std::string modulus_table(const Modulus& modulus, ElasticUpdate form, double shear_ratio, const ModulusStates& states)
{
  std::string text = modulus_header();
  if (states.measured()) text += ",p_error[-],p_error_rms[-],K_error[-],K_error_rms[-]";
  RelativeErrors of_pressure, of_modulus;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ModulusAnswer answer = answer_at(modulus, form, states.elastic[i], states.plastic[i]);
    text += "\n" + modulus_row(states.elastic[i], states.plastic[i], answer, shear_ratio);
    if (!states.measured()) continue;
    text += of_pressure.columns(answer.pressure, states.pressure[i]);
    text += of_modulus.columns(answer.bulk_modulus, states.bulk_modulus[i]);
  }
  return text + "\n";
}

ModulusCosts modulus_costs(const Modulus& modulus, ElasticUpdate form, const ModulusStates& states, int n_rounds)
{
  std::vector<double> pressures;
  for (std::size_t i = 0; i < states.size(); ++i) {
    pressures.push_back(answer_at(modulus, form, states.elastic[i], states.plastic[i]).pressure);
  }
  compare::ModulusTiming timing(modulus, form, pressures, states.elastic, states.plastic);
  std::vector<double> seconds;
  seconds.reserve(static_cast<std::size_t>(n_rounds));
  for (int round = 0; round < n_rounds; ++round) seconds.push_back(seconds_of([&] { timing.evaluate(); }));
  return {timing.n_states(), median(seconds) / static_cast<double>(timing.n_states()) * 1e9, bytes_of(modulus)};
}

}  // namespace tamp::tools
