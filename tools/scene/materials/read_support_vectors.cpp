#include "tools/scene/materials/read_support_vectors.hpp"

#include <fmt/core.h>

#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

namespace
{

using components::SupportVectorFit;

/// A value out of lists in which it stands alone: [[5]] is 5.
const Json& unwrapped(const Json& value)
{
  return value.is_array() && value.size() == 1 ? unwrapped(value.front()) : value;
}

constexpr std::size_t most_vectors = 20'000;

const ObjectKeys& fit_keys()
{
  static const ObjectKeys keys{"",
                               {{"X_conversion_factor", Numbers{just(2), above_zero}, "", compulsory, ""},
                                {"X_scale", Numbers{just(2), above_zero}, "", compulsory, ""},
                                {"X_min", Numbers{just(2)}, "", compulsory, ""},
                                {"X_max", Numbers{just(2)}, "", compulsory, ""},
                                {"y_conversion_factor", Number{above_zero}, "", compulsory, ""},
                                {"y_scale", Number{above_zero}, "", compulsory, ""},
                                {"y_min", Number{}, "", compulsory, ""},
                                {"gamma", Number{above_zero}, "", compulsory, ""},
                                {"intercept", Number{}, "", compulsory, ""}}};
  return keys;
}

class SupportVectorReader
{
 public:
  explicit SupportVectorReader(const std::filesystem::path& file)
      : document_(file, fit_keys()), reader_(document_, fit_keys())
  {
  }

  SupportVectorFit read()
  {
    SupportVectorFit fit{};
    read_inputs(fit);
    fit.pressure_unit = number("y_conversion_factor");
    fit.pressure_scale = number("y_scale");
    fit.pressure_lower = number("y_min");
    fit.gamma = number("gamma");
    fit.intercept = number("intercept");
    fit.vectors = read_vectors();
    fit.coefficients = read_coefficients(fit.vectors.size());
    if (!document_.problems.empty()) throw InputError(std::move(document_.problems));
    return fit;
  }

 private:
  double number(const std::string& key)
  {
    if (reader_.has(key)) document_.root[key] = Json(unwrapped(document_.root[key]));
    return reader_.number(key);
  }

  std::vector<double> pair(const std::string& key)
  {
    if (reader_.has(key)) {
      Json value = unwrapped(document_.root[key]);
      if (value.is_array()) {
        for (Json& item : value) item = Json(unwrapped(item));
      }
      document_.root[key] = std::move(value);
    }
    return reader_.numbers(key);
  }

  void read_inputs(SupportVectorFit& fit)
  {
    const std::vector<double> unit = pair("X_conversion_factor"), scale = pair("X_scale");
    const std::size_t n_before = document_.problems.size();
    const std::vector<double> lower = pair("X_min"), upper = pair("X_max");
    const bool bounds_are_good = document_.problems.size() == n_before;
    if (bounds_are_good && !(lower[0] < upper[0] && lower[1] < upper[1])) {
      reader_.add_problem("X_max", fmt::format("[{}, {}]", upper[0], upper[1]),
                          fmt::format("expected more than X_min, [{}, {}]", lower[0], lower[1]));
    }
    fit.total = {unit[0], lower[0], upper[0], scale[0]};
    fit.plastic = {unit[1], lower[1], upper[1], scale[1]};
  }

  /// The list at a key, or nothing where a problem was noted.
  const Json* list(const std::string& key)
  {
    const std::string expected = "expected a list that is not empty";
    if (!reader_.has(key)) {
      reader_.add_problem(key, "missing", expected);
      return nullptr;
    }
    const Json& value = document_.root[key];
    if (value.is_array() && !value.empty()) return &value;
    reader_.add_problem(key, value.is_array() ? "an empty list" : value.type_name(), expected);
    return nullptr;
  }

  std::vector<std::array<double, 2>> read_vectors()
  {
    const Json* const rows = list("support_vectors");
    std::vector<std::array<double, 2>> vectors;
    if (rows != nullptr && rows->size() > most_vectors) {
      reader_.add_problem("support_vectors", fmt::format("{} of them", rows->size()),
                          fmt::format("expected at most {}, as each is asked in every update", most_vectors));
      return vectors;
    }
    for (std::size_t i = 0; rows != nullptr && i < rows->size(); ++i) {
      const Json& row = rows->at(i);
      if (!row.is_array() || row.size() != 2 || !row[0].is_number() || !row[1].is_number()) {
        document_.add_problem(reader_.pointer("support_vectors") / i, row.dump(), "expected two numbers");
        return vectors;
      }
      vectors.push_back({row[0].get<double>(), row[1].get<double>()});
    }
    return vectors;
  }

  std::vector<double> read_coefficients(std::size_t n_vectors)
  {
    const Json* row = list("dual_coeffs");
    if (row == nullptr) return {};
    JsonPointer pointer = reader_.pointer("dual_coeffs");
    if (row->size() == 1 && row->front().is_array()) {
      row = &row->front();
      pointer /= std::size_t{0};
    }
    for (std::size_t i = 0; i < row->size(); ++i) {
      if (row->at(i).is_number()) continue;
      document_.add_problem(pointer / i, row->at(i).dump(), "expected a number");
      return {};
    }
    if (row->size() != n_vectors && document_.problems.empty()) {
      document_.add_problem(pointer, fmt::format("{} numbers", row->size()),
                            fmt::format("expected {}, one for each support vector", n_vectors));
    }
    return row->get<std::vector<double>>();
  }

  Document document_;
  JsonReader reader_;
};

}  // namespace

components::SupportVectorFit read_support_vectors(const std::filesystem::path& file)
{
  return SupportVectorReader(file).read();
}

}  // namespace tamp::tools
