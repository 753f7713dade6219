#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/scene/json_reader.hpp"
#include "tools/scene/parse_json.hpp"
#include "tools/study/points.hpp"
#include "tools/study/study.hpp"
#include "tools/study/study_keys.hpp"

namespace tamp::tools::study
{

namespace
{

constexpr std::size_t fewest_grids = 3;

/// Numbers above 0 that fall or rise.
bool are_spacings(const std::vector<Json>& values)
{
  const auto is_bad = [](const Json& value) { return !value.is_number() || value.get<double>() <= 0; };
  if (std::any_of(values.begin(), values.end(), is_bad)) return false;
  const auto rises = [](const Json& a, const Json& b) { return a.get<double>() < b.get<double>(); };
  const auto falls = [](const Json& a, const Json& b) { return a.get<double>() > b.get<double>(); };
  const auto all_are = [&](auto in_order) {
    return std::adjacent_find(values.begin(), values.end(),
                              [&](const Json& a, const Json& b) { return !in_order(a, b); }) == values.end();
  };
  return all_are(rises) || all_are(falls);
}

/// Reads a study, noting all that is wrong.
class StudyReader
{
 public:
  explicit StudyReader(Document& document) : document_(document), root_(document, study_keys()) {}

  Study read()
  {
    study_.file = document_.file();
    study_.title = root_.text("title", document_.file().stem().string());
    study_.about = root_.text("about", "");
    study_.takes = root_.text("takes", "");
    read_measure();
    study_.settings = settings(root_, "set");
    read_methods();
    read_points();
    study_.refine = pointer(root_, "refine");
    read_quantities();
    read_reference();
    read_budget();
    read_expectations();
    read_stability();
    read_stable_if();
    read_map();
    read_limits();
    root_.finish();
    expect_answers();
    expect_few_points();
    return std::move(study_);
  }

 private:
  void read_measure()
  {
    JsonReader reader = root_.object("measure");
    using Kind = Measure::Kind;
    const std::vector<std::pair<std::string, Kind>> kinds{
        {"run", Kind::run}, {"drive", Kind::drive}, {"modulus", Kind::modulus}};
    const auto is_there = [&](const auto& kind) { return reader.has(kind.first); };
    if (std::count_if(kinds.begin(), kinds.end(), is_there) != 1) {
      root_.add_problem("measure", "not one thing to measure", "expected one of run, drive, modulus");
      return;
    }
    const auto& [key, kind_of_key] = *std::find_if(kinds.begin(), kinds.end(), is_there);
    const Kind kind = study_.measure.kind = kind_of_key;
    study_.measure.file = from_here(reader.existing_file(key));
    if (kind == Kind::drive) study_.measure.along = from_here(reader.existing_file("path"));
    if (kind == Kind::drive) study_.measure.increment = reader.number("increment");
    if (kind == Kind::modulus) study_.measure.along = from_here(reader.existing_file("states"));
    const auto is_needed = [&](const char* name) {
      return (name == std::string("path") && kind == Kind::drive) ||
             (name == std::string("states") && kind == Kind::modulus);
    };
    for (const char* name : {"path", "states"}) {
      if (reader.has(name) && !is_needed(name)) reader.add_problem(name, "given beside " + key, "expected no such key");
    }
    reader.finish();
  }

  void read_methods()
  {
    const std::vector<Axis> sweep = axes(root_, "sweep");
    for (JsonReader& reader : root_.objects("methods")) {
      Method method;
      method.name = reader.text("name", "");
      if (method.name.empty()) reader.add_problem("name", "no name", "expected a text");
      if (method.name == reference_name || method.name == budget_name || find_method(method.name) != nullptr) {
        reader.add_problem("name", fmt::format("\"{}\", which is taken", method.name), "expected another name");
      }
      method.family = reader.text("family", method.name);
      method.dashed = reader.flag("dashed");
      method.another_model = reader.flag("another_model");
      method.settings = settings(reader, "set");
      method.sweep = reader.has("sweep") ? axes(reader, "sweep") : sweep;
      reader.finish();
      study_.methods.push_back(std::move(method));
    }
    if (study_.methods.empty()) root_.add_problem("methods", "no method", "expected one at least");
  }

  void read_points()
  {
    for (JsonReader& reader : root_.objects("points")) {
      const std::string name = reader.text("method", "");
      Method* method = find_method(name);
      if (method == nullptr) {
        reader.add_problem("method", fmt::format("\"{}\"", name), "expected the name of a method");
      } else {
        method->listed.push_back(settings(reader, "set"));
      }
      reader.finish();
    }
  }

  void read_quantities()
  {
    for (JsonReader& reader : root_.objects("quantities")) {
      Quantity quantity;
      quantity.name = reader.text("name", "");
      if (quantity.name.empty() || find_quantity(quantity.name)) {
        reader.add_problem("name", quantity.name.empty() ? "no name" : "a name that is taken",
                           "expected a name of its own");
      }
      quantity.summary = pointer(reader, "summary");
      if (quantity.is_of_summary()) {
        refuse_places(reader);
      } else {
        quantity.take = reader.choice<Take>("take");
        read_place(reader, quantity);
      }
      quantity.exact = reader.optional_number("exact");
      quantity.scale = reader.optional_number("scale");
      reader.finish();
      study_.quantities.push_back(std::move(quantity));
    }
    if (study_.quantities.empty()) {
      root_.add_problem("quantities", "no quantity", "expected one at least: a column, and how it is taken");
    }
  }

  /// A number of the summary is there already.
  static void refuse_places(JsonReader& reader)
  {
    for (const char* key : {"take", "column", "plus", "at", "field", "component", "material", "line", "quantile"}) {
      if (reader.has(key)) reader.add_problem(key, "given beside summary", "expected one or the other");
    }
  }

  void read_place(JsonReader& reader, Quantity& quantity)
  {
    if (!quantity.is_of_field()) {
      quantity.column = reader.text("column", "");
      if (quantity.column.empty()) reader.add_problem("column", "missing", "expected the name of a column");
      if (quantity.take == Take::value || quantity.take == Take::mean) quantity.time = reader.number("at");
      quantity.plus = names(reader, "plus");
      return;
    }
    quantity.field = reader.text("field", "");
    quantity.material = reader.text("material", "");
    if (reader.has("component")) quantity.component = reader.whole_number("component");
    if (quantity.take == Take::quantile) quantity.quantile = reader.number("quantile");
    if (quantity.take == Take::field_rms) quantity.line = line(reader);
    if (quantity.field.empty()) reader.add_problem("field", "missing", "expected a field of the particles");
    if (quantity.material.empty()) reader.add_problem("material", "missing", "expected the name of a material");
    if (study_.measure.kind != Measure::Kind::run) {
      reader.add_problem("take", "what is taken of a field", "expected it in studies of runs only");
    }
  }

  void read_reference()
  {
    auto reader = root_.optional_object("reference");
    if (!reader) return;
    ReferenceRuns reference;
    reference.settings = settings(*reader, "set");
    reference.refinement.pointer = pointer(*reader, "refine");
    reference.refinement.values = list(*reader, "values");
    reference.of_each_method = reader->flag("of_each_method");
    for (const Json& one : list(*reader, "beside")) reference.beside.push_back(settings_of(one, *reader, "beside"));
    if (!reference.refinement.pointer.empty() && reference.refinement.values.size() < fewest_grids) {
      reader->add_problem(
          "values", fmt::format("{} values", reference.refinement.values.size()),
          fmt::format("expected {} at least, from coarse to fine: an order takes as many", fewest_grids));
    }
    if (!are_spacings(reference.refinement.values)) {
      reader->add_problem("values", "values that are no spacings",
                          "expected numbers above 0, each less than the one before, or each greater");
    }
    if (reference.refinement.pointer.empty() && !reference.refinement.values.empty()) {
      reader->add_problem("refine", "missing", "expected the JSON pointer whose values are given");
    }
    reader->finish();
    study_.reference = std::move(reference);
  }

  void read_budget()
  {
    auto reader = root_.optional_object("budget");
    if (!reader) return;
    Budget budget;
    for (const Json& name : list(*reader, "quantities")) {
      if (name.is_string() && find_quantity(name.get<std::string>())) {
        budget.quantities.push_back(name);
      } else {
        reader->add_problem("quantities", name.dump(), "expected names of quantities");
      }
    }
    for (JsonReader& base : reader->objects("of")) {
      budget.bases.push_back({base.text("name", ""), settings(base, "set")});
      base.finish();
    }
    for (JsonReader& part : reader->objects("parts")) budget.parts.push_back(budget_part(part));
    reader->finish();
    study_.budget = std::move(budget);
  }

  BudgetPart budget_part(JsonReader& reader)
  {
    BudgetPart part;
    part.name = reader.text("name", "");
    part.to_reference = reader.flag("to_reference");
    for (const Json& one : list(reader, "set")) part.variations.push_back(settings_of(one, reader, "set"));
    if (part.to_reference == !part.variations.empty()) {
      reader.add_problem("set", part.to_reference ? "given beside to_reference" : "missing",
                         "expected either changes, or to_reference");
    }
    if (part.to_reference && !study_.reference) {
      reader.add_problem("to_reference", "true", "expected a study with a reference");
    }
    if (part.to_reference && study_.reference && study_.reference->of_each_method) {
      reader.add_problem("to_reference", "true", "expected one reference for all methods");
    }
    reader.finish();
    return part;
  }

  void read_expectations()
  {
    for (JsonReader& reader : root_.objects("expect")) {
      Expectation expected;
      expected.quantity = reader.text("quantity", "");
      if (!find_quantity(expected.quantity)) {
        reader.add_problem("quantity", fmt::format("\"{}\"", expected.quantity), "expected the name of a quantity");
      }
      expected.methods = names(reader, "methods");
      for (const std::string& name : expected.methods) {
        if (find_method(name) != nullptr) continue;
        reader.add_problem("methods", fmt::format("\"{}\"", name), "expected names of methods");
      }
      if (!reader.has("methods")) {
        for (const Method& method : study_.methods) expected.methods.push_back(method.name);
      }
      read_bar(reader, expected);
      read_terms(reader, expected);
      expected.why = reader.text("why", "");
      read_misses(reader, expected);
      reader.finish();
      study_.expectations.push_back(std::move(expected));
    }
  }

  /// One of the keys that say what has to hold.
  void read_bar(JsonReader& reader, Expectation& expected)
  {
    using Kind = Expectation::Kind;
    const std::vector<std::pair<std::string, Kind>> kinds{
        {"order_at_least", Kind::order_at_least},           {"order_at_most", Kind::order_at_most},
        {"error_at_least", Kind::error_at_least},           {"error_at_most", Kind::error_at_most},
        {"limit_error_at_most", Kind::limit_error_at_most}, {"fails", Kind::fails}};
    const auto is_there = [&](const auto& kind) { return reader.has(kind.first); };
    if (std::count_if(kinds.begin(), kinds.end(), is_there) != 1) {
      reader.add_problem("quantity", fmt::format("\"{}\", of which not one thing is to hold", expected.quantity),
                         "expected one of order_at_least, order_at_most, error_at_least, error_at_most, "
                         "limit_error_at_most, fails");
      return;
    }
    const auto& [key, kind] = *std::find_if(kinds.begin(), kinds.end(), is_there);
    expected.kind = kind;
    const bool is_of_order = kind == Kind::order_at_least || kind == Kind::order_at_most;
    const bool is_of_limit = kind == Kind::limit_error_at_most;
    if ((is_of_order || is_of_limit) && study_.refine.empty()) {
      reader.add_problem(key, fmt::format("{} in a study that refines nothing", is_of_order ? "an order" : "a limit"),
                         "expected the key refine");
    }
    if (is_of_limit && !has_exact_answer(expected.quantity)) {
      reader.add_problem(key, "the limit of a quantity without an exact answer", "expected one with the key exact");
    }
    if (kind != Kind::fails) {
      expected.limit = reader.number(key);
    } else if (!reader.flag(key)) {
      reader.add_problem(key, "false", "expected true, or another key: what has to hold is said");
    }
  }

  /// The keys that go with some of them alone.
  void read_terms(JsonReader& reader, Expectation& expected)
  {
    using Kind = Expectation::Kind;
    const bool is_of_one = expected.kind == Kind::error_at_least || expected.kind == Kind::error_at_most;
    if (reader.has("at") && !(is_of_one && !study_.refine.empty())) {
      reader.add_problem("at", "given where no error of one of several grids is judged",
                         "expected it beside error_at_least or error_at_most, in a study that refines something");
    }
    if (reader.has("limit_order") && expected.kind != Kind::limit_error_at_most) {
      reader.add_problem("limit_order", "given where no limit is judged", "expected it beside limit_error_at_most");
    }
    expected.at = reader.optional_number("at");
    expected.limit_order = reader.number("limit_order");
  }

  void read_misses(JsonReader& reader, Expectation& expected)
  {
    const std::string key = "missed";
    if (!reader.has(key)) return;
    const Json& misses = document_.root.at(reader.pointer(key));
    if (!misses.is_object()) {
      return reader.add_problem(key, misses.type_name(), "expected an object: method → why it misses");
    }
    for (const auto& [method, why] : misses.items()) {
      if (std::find(expected.methods.begin(), expected.methods.end(), method) == expected.methods.end()) {
        reader.add_problem(key, fmt::format("\"{}\"", method), "expected methods of which it is expected");
      }
      if (!why.is_string() || why.get<std::string>().empty()) {
        reader.add_problem(key, fmt::format("{} for \"{}\"", why.dump(), method), "expected why, in words");
      } else {
        expected.missed.emplace(method, why);
      }
    }
  }

  void read_stability()
  {
    auto reader = root_.optional_object("stability");
    if (!reader) return;
    Stability stability;
    stability.quantity = needed_text(*reader, "quantity");
    stability.threshold = reader->number("threshold");
    stability.fails = method_with_one_point(*reader, "fails");
    stability.survives = method_with_one_point(*reader, "survives");
    stability.symptom = needed_text(*reader, "symptom");
    stability.monitor = needed_text(*reader, "monitor");
    if (!stability.quantity.empty() && !has_error(stability.quantity)) {
      reader->add_problem("quantity", fmt::format("\"{}\"", stability.quantity),
                          "expected the name of a quantity with an exact answer, or of a study with a reference");
    }
    if (!stability.fails.empty() && stability.fails == stability.survives) {
      reader->add_problem("survives", fmt::format("\"{}\", which fails", stability.survives),
                          "expected another method");
    }
    reader->finish();
    study_.stability = std::move(stability);
  }

  static std::string needed_text(JsonReader& reader, const std::string& key)
  {
    std::string text = reader.text(key, "");
    if (text.empty()) reader.add_problem(key, "missing", "expected a text");
    return text;
  }

  /// One number is judged.
  std::string method_with_one_point(JsonReader& reader, const std::string& key)
  {
    std::string name = needed_text(reader, key);
    if (name.empty()) return name;
    const Method* method = find_method(name);
    if (method == nullptr) {
      reader.add_problem(key, fmt::format("\"{}\"", name), "expected the name of a method");
    } else if (!method->sweep.empty() || method->listed.size() > 1) {
      reader.add_problem(key, fmt::format("\"{}\", of several points", name), "expected a method with one");
    }
    return name;
  }

  void read_map()
  {
    auto reader = root_.optional_object("map");
    if (!reader) return;
    StudyMap map;
    map.quantity = reader->text("quantity", "");
    if (!find_quantity(map.quantity)) {
      reader->add_problem("quantity", fmt::format("\"{}\"", map.quantity), "expected the name of a quantity");
    }
    map.noisy = reader->number("noisy");
    map.blown = reader->number("blown");
    if (map.noisy >= map.blown) {
      reader->add_problem("blown", fmt::format("{}", map.blown),
                          fmt::format("expected more than noisy, {}", map.noisy));
    }
    for (JsonReader& sheet : reader->objects("sheets")) map.sheets.push_back(map_sheet(sheet));
    reader->finish();
    study_.map = std::move(map);
  }

  MapSheet map_sheet(JsonReader& reader)
  {
    MapSheet sheet{reader.text("name", ""), names(reader, "methods"), pointer(reader, "rows"),
                   pointer(reader, "columns"), reader.optional_number("bound")};
    for (const std::string& name : sheet.methods) {
      if (find_method(name) != nullptr) continue;
      reader.add_problem("methods", fmt::format("\"{}\"", name), "expected names of methods");
    }
    for (const std::string& one : {sheet.rows, sheet.columns}) {
      if (!one.empty() && !is_set(one, sheet.methods)) {
        reader.add_problem(one == sheet.rows ? "rows" : "columns", one, "expected what its methods set");
      }
    }
    reader.finish();
    return sheet;
  }

  /// Whether each of these methods sets a pointer.
  bool is_set(const std::string& pointer, const std::vector<std::string>& methods)
  {
    return std::all_of(methods.begin(), methods.end(), [&](const std::string& name) {
      const Method* method = find_method(name);
      if (method == nullptr) return true;  // told already
      const auto is_it = [&](const auto& setting) { return setting.first == pointer; };
      return std::any_of(study_.settings.begin(), study_.settings.end(), is_it) ||
             std::any_of(method->settings.begin(), method->settings.end(), is_it) ||
             std::any_of(method->sweep.begin(), method->sweep.end(),
                         [&](const Axis& axis) { return axis.pointer == pointer; });
    });
  }

  void read_stable_if()
  {
    auto reader = root_.optional_object("stable_if");
    if (!reader) return;
    StableIf& stable = study_.stable_if;
    stable.energy_error = reader->optional_number("energy_error_at_most");
    stable.quantity = reader->text("quantity", "");
    stable.error = reader->optional_number("error_at_most");
    if (!stable.quantity.empty() && !has_exact_answer(stable.quantity)) {
      reader->add_problem("quantity", fmt::format("\"{}\"", stable.quantity),
                          "expected the name of a quantity with an exact answer");
    }
    if (stable.quantity.empty() == stable.error.has_value()) {
      reader->add_problem("error_at_most", stable.error ? "given without a quantity" : "missing",
                          "expected both quantity and error_at_most, or neither");
    }
    reader->finish();
  }

  void read_limits()
  {
    study_.repeat = root_.whole_number("repeat");
    study_.repeat_below = root_.number("repeat_below_s");
    study_.limit = root_.optional_number("limit_s").value_or(study_.limit);
    study_.limit_over_fastest = root_.optional_number("limit_times_fastest").value_or(study_.limit_over_fastest);
    study_.n_threads = root_.whole_number("threads");
  }

  /// Columns mean something only beside another.
  void expect_answers()
  {
    for (const Quantity& quantity : study_.quantities) {
      if (quantity.is_column() && !study_.reference) {
        root_.add_problem("quantities", fmt::format("\"{}\", a column, without a reference", quantity.name),
                          "expected a reference to compare it with");
      }
      if (quantity.take == Take::farthest && !quantity.exact) {
        root_.add_problem("quantities", fmt::format("\"{}\", the value farthest from no number", quantity.name),
                          "expected the exact answer");
      }
      if (quantity.is_column() && quantity.exact) {
        root_.add_problem("quantities", fmt::format("\"{}\", a column, with an exact number", quantity.name),
                          "expected a number that is taken of it");
      }
    }
  }

  /// Counted before they are made, and reported where most of them come from.
  void expect_few_points()
  {
    const auto all = n_points_by_key();
    const auto is_less = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto most = std::max_element(all.begin(), all.end(), is_less);
    double n = 0;
    for (const auto& [key, points] : all) n += points;
    if (n <= most_points) return;
    document_.add_problem(JsonPointer(most->first), n < 1e15 ? fmt::format("{:.0f} points", n) : "over 1e15 points",
                          fmt::format("expected at most {:.0f}", most_points));
  }

  /// In floating point, which knows no overflow.
  std::vector<std::pair<std::string, double>> n_points_by_key() const
  {
    std::vector<std::pair<std::string, double>> all;
    for (std::size_t i = 0; i < study_.methods.size(); ++i) {
      const Method& method = study_.methods[i];
      const std::string own = fmt::format("/methods/{}/sweep", i);
      double n = method.sweep.empty() && !method.listed.empty() ? 0 : 1;
      for (const Axis& axis : method.sweep) n *= static_cast<double>(axis.values.size());
      all.emplace_back(document_.root.contains(JsonPointer(own)) ? own : "/sweep", n);
      all.emplace_back("/points", static_cast<double>(method.listed.size()));
    }
    if (study_.reference) {
      const ReferenceRuns& reference = *study_.reference;
      const std::size_t n = std::max<std::size_t>(reference.refinement.values.size(), 1) + reference.beside.size();
      const std::size_t n_references = reference.of_each_method ? study_.methods.size() : 1;
      all.emplace_back("/reference", static_cast<double>(n) * static_cast<double>(n_references));
    }
    if (study_.budget) {
      double n = 1;
      for (const BudgetPart& part : study_.budget->parts) n += static_cast<double>(part.variations.size());
      all.emplace_back("/budget", n * static_cast<double>(study_.budget->bases.size()));
    }
    return all;
  }

  std::string pointer(JsonReader& reader, const std::string& key)
  {
    const std::string text = reader.text(key, "");
    if (!text.empty() && !is_pointer(text)) {
      reader.add_problem(key, fmt::format("\"{}\"", text), "expected a JSON pointer, such as /grid/cell_size");
      return {};
    }
    return text;
  }

  std::vector<std::string> names(JsonReader& reader, const std::string& key)
  {
    std::vector<std::string> names;
    for (const Json& name : list(reader, key)) {
      if (name.is_string()) {
        names.push_back(name);
      } else {
        reader.add_problem(key, name.dump(), "expected a list of texts");
      }
    }
    return names;
  }

  /// A number at the origin, and one for each axis of a scene.
  std::vector<double> line(JsonReader& reader)
  {
    std::vector<double> numbers;
    for (const Json& number : list(reader, "line")) {
      if (number.is_number()) numbers.push_back(number);
    }
    if (numbers.size() < 3 || numbers.size() > 4 || numbers.size() != list(reader, "line").size()) {
      reader.add_problem("line", reader.has("line") ? "not that" : "missing",
                         "expected a list of 3 or 4 numbers: at the origin, and for each metre along each axis");
    }
    return numbers;
  }

  std::vector<Json> list(JsonReader& reader, const std::string& key)
  {
    if (!reader.has(key)) return {};
    const Json& value = document_.root.at(reader.pointer(key));
    if (value.is_array()) return {value.begin(), value.end()};
    reader.add_problem(key, value.type_name(), "expected a list");
    return {};
  }

  Settings settings(JsonReader& reader, const std::string& key)
  {
    if (!reader.has(key)) return {};
    return settings_of(document_.root.at(reader.pointer(key)), reader, key);
  }

  Settings settings_of(const Json& object, JsonReader& reader, const std::string& key)
  {
    if (!object.is_object()) {
      reader.add_problem(key, object.type_name(), "expected an object: JSON pointer → value");
      return {};
    }
    Settings settings;
    for (const auto& [text, value] : object.items()) {
      if (!is_pointer(text)) {
        reader.add_problem(key, fmt::format("\"{}\"", text), "expected a JSON pointer, such as /grid/cell_size");
      } else {
        settings.emplace_back(text, with_file_from_here(value));
      }
    }
    return settings;
  }

  std::vector<Axis> axes(JsonReader& reader, const std::string& key)
  {
    std::vector<Axis> axes;
    for (const auto& [text, value] : settings(reader, key)) {
      if (!value.is_array() || value.empty()) {
        reader.add_problem(key, fmt::format("{} at {}", value.dump(), text), "expected a list of values");
        continue;
      }
      Axis axis{text, {}};
      for (const Json& one : value) axis.values.push_back(with_file_from_here(one));
      axes.push_back(std::move(axis));
    }
    return axes;
  }

  /// Files are named from the study's folder; commands name them from the current one.
  Json with_file_from_here(const Json& value) const
  {
    if (!value.is_string()) return value;
    const std::filesystem::path file = document_.file().parent_path() / value.get<std::string>();
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return value;
    const std::string path = from_here(file).string();
    if (utf8(path) == path) return path;
    throw InputError({document_.file().string(), "a setting that names " + path, "expected a path that is UTF-8"});
  }

  static std::filesystem::path from_here(const std::filesystem::path& file)
  {
    return file.empty() ? file : std::filesystem::proximate(file);
  }

  Method* find_method(const std::string& name)
  {
    const auto at = std::find_if(study_.methods.begin(), study_.methods.end(),
                                 [&](const Method& method) { return method.name == name; });
    return at == study_.methods.end() ? nullptr : &*at;
  }

  bool find_quantity(const std::string& name) const
  {
    return std::any_of(study_.quantities.begin(), study_.quantities.end(),
                       [&](const Quantity& quantity) { return quantity.name == name; });
  }

  bool has_error(const std::string& name) const
  {
    return has_exact_answer(name) || (find_quantity(name) && study_.reference);
  }

  bool has_exact_answer(const std::string& name) const
  {
    return std::any_of(study_.quantities.begin(), study_.quantities.end(),
                       [&](const Quantity& quantity) { return quantity.name == name && quantity.exact; });
  }

  Document& document_;
  JsonReader root_;
  Study study_;
};

}  // namespace

Study read_study(const std::filesystem::path& file, bool in_short)
{
  Document document(file, study_keys());
  if (in_short && document.root.contains("short")) {
    const Json patch = document.root["short"];
    if (!patch.is_object()) throw InputError({file.string() + "#/short", patch.type_name(), "expected an object"});
    document.root.merge_patch(patch);
  }
  Study study = StudyReader(document).read();
  if (!document.problems.empty()) throw InputError(std::move(document.problems));
  return study;
}

}  // namespace tamp::tools::study
