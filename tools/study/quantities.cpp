#include "tools/study/quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/file_error.hpp"
#include "runtime/storage/hdf5.hpp"
#include "tools/system/errors.hpp"

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

/// NaN where there is no row from that time on.
double mean_from(const std::vector<double>& times, const std::vector<double>& values, double time)
{
  const auto first = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  const double sum = std::accumulate(values.begin() + first, values.end(), 0.0);
  return sum / static_cast<double>(values.end() - values.begin() - first);
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

std::size_t place_of_farthest(const std::vector<double>& values, double exact)
{
  const auto is_nearer = [=](double a, double b) { return std::abs(a - exact) < std::abs(b - exact); };
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end(), is_nearer) - values.begin());
}

/// The last output of the fields of a quantity's material.
class FieldsOfMaterial
{
 public:
  FieldsOfMaterial(const Study& study, const Quantity& quantity, const PointResult& result)
      : study_(study),
        quantity_(quantity),
        file_(result.folder / "fields.h5", runtime::hdf5::OpenFile::Access::read, "cannot read fields"),
        last_(last_output())
  {
  }

  /// A number of each particle: of a field of numbers, or a component of one of vectors.
  std::vector<double> values() const
  {
    if (!quantity_.component) return numbers(quantity_.field);
    const std::vector<double> vectors = numbers_of_vectors(quantity_.field);
    std::vector<double> values;
    for (std::size_t i = static_cast<std::size_t>(*quantity_.component); i < vectors.size(); i += 3) {
      values.push_back(vectors[i]);
    }
    return values;
  }
  /// Three of each particle.
  std::vector<double> positions() const { return numbers_of_vectors("position"); }

 private:
  std::string last_output() const
  {
    const std::vector<std::string> outputs = file_.members(runtime::hdf5::MemberOrder::by_name);
    if (outputs.empty()) throw runtime::FileError(file_.file().string(), "has no output of fields");
    return outputs.back();
  }

  std::vector<double> numbers(const std::string& field) const
  {
    return read(field, [](const auto& dimensions) { return dimensions.size() == 1; });
  }
  std::vector<double> numbers_of_vectors(const std::string& field) const
  {
    return read(field, [](const auto& dimensions) { return dimensions.size() == 2 && dimensions[1] == 3; });
  }

  template <class IsOfShape>
  std::vector<double> read(const std::string& field, const IsOfShape& is_of_shape) const
  {
    const std::string path = fmt::format("{}/particles/{}/{}", last_, quantity_.material, field);
    std::vector<double> values;
    try {
      if (is_of_shape(file_.info(path).dimensions)) values = file_.read<double>(path);
    } catch (const runtime::FileError&) {
      // Told below, in the study's words.
    }
    if (!values.empty()) return values;
    throw InputError({study_.file.string() + "#/quantities",
                      fmt::format("there are no numbers {} of {}", field, quantity_.material),
                      "expected a field of numbers that the runs write, or a component of one of vectors"});
  }

  const Study& study_;
  const Quantity& quantity_;
  runtime::hdf5::OpenFile file_;
  std::string last_;
};

double quantile_of_field(const Study& study, const Quantity& quantity, const PointResult& result)
{
  std::vector<double> values = FieldsOfMaterial(study, quantity, result).values();
  const auto place = static_cast<std::ptrdiff_t>(quantity.quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values.at(static_cast<std::size_t>(place));
}

double distance_from_line(const Study& study, const Quantity& quantity, const PointResult& result)
{
  const FieldsOfMaterial fields(study, quantity, result);
  const std::vector<double> values = fields.values(), positions = fields.positions();
  if (positions.size() != 3 * values.size()) {
    throw runtime::FileError((result.folder / "fields.h5").string(), "has not a position of each particle");
  }
  double sum = 0;
  for (std::size_t p = 0; p < values.size(); ++p) {
    double expected = quantity.line.front();
    for (std::size_t k = 1; k < quantity.line.size(); ++k) expected += quantity.line[k] * positions[3 * p + k - 1];
    sum += (values[p] - expected) * (values[p] - expected);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double number_of_summary(const Study& study, const Quantity& quantity, const PointResult& result)
{
  const Json summary = summary_in(result.folder);
  if (const Json* number = find_value(summary, quantity.summary); number != nullptr && number->is_number())
    return *number;
  throw InputError({study.file.string() + "#/quantities",
                    fmt::format("\"{}\": there is no number at {}", quantity.name, quantity.summary),
                    "expected a JSON pointer to a number of summary.json"});
}

/// The quantity's column with those that are added to it.
std::vector<double> summed_column(const Study& study, const Quantity& quantity, const Columns& columns)
{
  std::vector<double> sum = column(study, columns, quantity.column);
  for (const std::string& name : quantity.plus) {
    const std::vector<double>& more = column(study, columns, name);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
  }
  return sum;
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
  if (quantity.is_of_summary()) return {number_of_summary(study, quantity, result), {}, {}};
  if (quantity.take == Take::quantile) return {quantile_of_field(study, quantity, result), {}, {}};
  if (quantity.take == Take::field_rms) return {distance_from_line(study, quantity, result), {}, {}};
  const Columns& columns = result.columns();
  const std::vector<double> values = summed_column(study, quantity, columns);
  switch (quantity.take) {
    case Take::greatest:
      return {values[place_of_greatest(values)], {}, {}};
    case Take::least:
      return {*std::min_element(values.begin(), values.end()), {}, {}};
    case Take::last:
      return {values.back(), {}, {}};
    case Take::value:
      return {value_at(column(study, columns, time_column), values, quantity.time), {}, {}};
    case Take::mean:
      return {mean_from(column(study, columns, time_column), values, quantity.time), {}, {}};
    case Take::farthest:
      return {values[place_of_farthest(values, quantity.exact.value_or(0))], {}, {}};
    case Take::kept:
      return {values.back() / values.front(), {}, {}};
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
                     [](const Quantity& quantity) { return quantity.is_of_field(); });
}

bool has_all(const Study& study, const PointResult& result)
{
  const auto is_there = [&](const char* name) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(result.folder / name, missing);
    return !missing && size > 0;
  };
  const auto is_of_summary = [](const Quantity& quantity) { return quantity.is_of_summary(); };
  const bool asks_for_summary = std::any_of(study.quantities.begin(), study.quantities.end(), is_of_summary);
  return is_there("history.csv") && (is_there("fields.h5") || !asks_for_fields(study)) &&
         (is_there("summary.json") || !asks_for_summary);
}

void expect_all(const Study& study, const PointResult& result)
{
  for (const Quantity& quantity : study.quantities) answer_of(study, quantity, result);
}

std::string unit_of(const Quantity& quantity)
{
  if (quantity.take == Take::time_of_greatest) return "s";
  const std::size_t open = quantity.column.find('[');
  if (quantity.is_of_field() || open == std::string::npos) return "";
  const std::string unit = quantity.column.substr(open + 1, quantity.column.size() - open - 2);
  return unit == "-" ? "" : unit;
}

}  // namespace tamp::tools::study
