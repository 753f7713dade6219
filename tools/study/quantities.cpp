#include "tools/study/quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "runtime/file_error.hpp"
#include "runtime/storage/hdf5.hpp"
#include "tools/errors.hpp"

namespace tamp::tools::study
{

namespace
{

constexpr const char* time_column = "time[s]";

const std::vector<double>& column(const Study& study, const Columns& columns, const std::string& name)
{
  if (const auto at = columns.find(name); at != columns.end() && !at->second.empty()) return at->second;
  std::vector<std::string> names;
  for (const auto& [known, values] : columns) names.push_back(known);
  throw InputError({study.file.string() + "#/quantities", fmt::format("there is no column \"{}\"", name),
                    fmt::format("expected one of {}", fmt::join(names, ", "))});
}

/// Straight between the rows, constant beyond them.
double value_at(const std::vector<double>& times, const std::vector<double>& values, double time)
{
  const auto after = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin());
  if (after == 0) return values.front();
  if (after == times.size()) return values.back();
  const double part = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return values[after - 1] + part * (values[after] - values[after - 1]);
}

std::size_t place_of_greatest(const std::vector<double>& values)
{
  std::size_t at = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[at] || std::isnan(values[at])) at = i;
  }
  return at;
}

/// Where the parabola through the greatest value and its neighbours is highest.
double time_of_greatest(const std::vector<double>& times, const std::vector<double>& values)
{
  const std::size_t i = place_of_greatest(values);
  if (i == 0 || i + 1 == values.size()) return times[i];
  const double h0 = times[i] - times[i - 1], h1 = times[i + 1] - times[i];
  const double s0 = (values[i] - values[i - 1]) / h0, s1 = (values[i + 1] - values[i]) / h1;
  if (!(s0 > s1)) return times[i];
  // The slope falls from s0 in the middle of the first interval to s1 in the middle of the second.
  return times[i] - h0 / 2 + s0 / (s0 - s1) * (h0 + h1) / 2;
}

double quantile_of_field(const Study& study, const Quantity& quantity, const PointResult& result)
{
  namespace hdf5 = runtime::hdf5;
  const hdf5::OpenFile file(result.folder / "fields.h5", hdf5::OpenFile::Access::read, "cannot read fields");
  const std::string last = file.members(hdf5::MemberOrder::by_name).back();
  const std::string path = fmt::format("{}/particles/{}/{}", last, quantity.material, quantity.field);
  std::vector<double> values;
  try {
    if (file.info(path).dimensions.size() == 1) values = file.read<double>(path);
  } catch (const runtime::FileError&) {
    // Told below, in the study's words.
  }
  if (values.empty()) {
    throw InputError({study.file.string() + "#/quantities",
                      fmt::format("there are no numbers {} of {}", quantity.field, quantity.material),
                      "expected a scalar field that the runs write"});
  }
  const auto place = static_cast<std::ptrdiff_t>(quantity.quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values.at(static_cast<std::size_t>(place));
}

double curve_distance(const Answer& reference, const Answer& other)
{
  double apart = 0, greatest = 0;
  for (std::size_t i = 0; i < reference.times.size(); ++i) {
    const double there = value_at(other.times, other.column, reference.times[i]);
    if (!std::isfinite(there) || !std::isfinite(reference.column[i])) return NAN;
    apart = std::max(apart, std::abs(there - reference.column[i]));
    greatest = std::max(greatest, std::abs(reference.column[i]));
  }
  return greatest > 0 ? apart / greatest : apart;
}

/// Root mean square, and the greatest, of the differences relative to the reference; rows where that is 0 do not count.
/// NaN where nothing can be compared.
struct RowDistances {
  double rms = NAN, greatest = NAN;
};

RowDistances row_distances(const Answer& reference, const Answer& other)
{
  if (reference.column.size() != other.column.size()) return {};
  double sum = 0, greatest = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < reference.column.size(); ++i) {
    if (reference.column[i] == 0) continue;
    const double apart = std::abs(other.column[i] / reference.column[i] - 1);
    if (!std::isfinite(apart)) return {};
    sum += apart * apart;
    greatest = std::max(greatest, apart);
    ++n;
  }
  return n == 0 ? RowDistances{} : RowDistances{std::sqrt(sum / static_cast<double>(n)), greatest};
}

}  // namespace

Answer answer_of(const Study& study, const Quantity& quantity, const PointResult& result)
{
  if (quantity.take == Take::quantile) return {quantile_of_field(study, quantity, result), {}, {}};
  const Columns& columns = result.columns();
  const std::vector<double>& values = column(study, columns, quantity.column);
  switch (quantity.take) {
    case Take::greatest:
      return {values[place_of_greatest(values)], {}, {}};
    case Take::least:
      return {*std::min_element(values.begin(), values.end()), {}, {}};
    case Take::last:
      return {values.back(), {}, {}};
    case Take::value:
      return {value_at(column(study, columns, time_column), values, quantity.time), {}, {}};
    case Take::time_of_greatest:
      return {time_of_greatest(column(study, columns, time_column), values), {}, {}};
    case Take::curve:
      return {0, column(study, columns, time_column), values};
    default:
      return {0, {}, values};
  }
}

double distance(const Quantity& quantity, const Answer& a, const Answer& b)
{
  switch (quantity.take) {
    case Take::curve:
      return curve_distance(a, b);
    case Take::rows_rms:
      return row_distances(a, b).rms;
    case Take::rows_max:
      return row_distances(a, b).greatest;
    default:
      return b.value - a.value;
  }
}

bool asks_for_fields(const Study& study)
{
  return std::any_of(study.quantities.begin(), study.quantities.end(),
                     [](const Quantity& quantity) { return quantity.take == Take::quantile; });
}

bool has_all(const Study& study, const PointResult& result)
{
  const auto is_there = [&](const char* name) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(result.folder / name, missing);
    return !missing && size > 0;
  };
  return is_there("history.csv") && (is_there("fields.h5") || !asks_for_fields(study));
}

void expect_all(const Study& study, const PointResult& result)
{
  for (const Quantity& quantity : study.quantities) answer_of(study, quantity, result);
}

std::string unit_of(const Quantity& quantity)
{
  if (quantity.take == Take::time_of_greatest) return "s";
  const std::size_t open = quantity.column.find('[');
  if (quantity.take == Take::quantile || open == std::string::npos) return "";
  const std::string unit = quantity.column.substr(open + 1, quantity.column.size() - open - 2);
  return unit == "-" ? "" : unit;
}

}  // namespace tamp::tools::study
