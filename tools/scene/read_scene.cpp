#include "tools/scene/read_scene.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "components/errors.hpp"
#include "tasks/method.hpp"
#include "tasks/report/field_columns.hpp"
#include "tasks/report/report.hpp"
#include "tasks/set_up/settled_ground.hpp"
#include "tools/scene/bodies/check_bodies.hpp"
#include "tools/scene/bodies/read_body.hpp"
#include "tools/scene/check_axisymmetry.hpp"
#include "tools/scene/check_method.hpp"
#include "tools/scene/json/json_reader.hpp"
#include "tools/scene/json/parameter_keys.hpp"
#include "tools/scene/materials/read_material.hpp"

namespace tamp::tools
{

namespace
{

/// Reads the parts of a scene one after another; what a part needs of another is read before it.
class SceneReader
{
 public:
  explicit SceneReader(Document& document) : document_(document), root_(document, scene_keys()) {}

  tasks::Scene read()
  {
    scene_.name = document_.file().stem().string();
    scene_.title = root_.text("title", scene_.name);
    const std::size_t n_before = document_.problems.size();
    read_dimension();
    const bool dimension_is_good = document_.problems.size() == n_before;
    scene_.interpolator = root_.choice<tasks::Interpolator>("interpolator");
    read_grid();
    const bool grid_is_good = document_.problems.size() == n_before;
    read_faces(grid_is_good);
    read_time();
    read_transfer();
    if (document_.problems.size() == n_before) check_method(root_, scene_);
    scene_.deformation_update = root_.choice<tasks::DeformationUpdate>("deformation_update");
    scene_.anti_locking = root_.choice<tasks::AntiLocking>("anti_locking");
    scene_.stress_timing = root_.choice<tasks::StressTiming>("stress_timing");
    read_particles_per_cell();
    read_loads();
    if (scene_.axisymmetric && dimension_is_good) check_axisymmetry(root_, scene_, grid_is_good);
    read_materials();
    check_stress_timing(root_, scene_);
    read_bodies(dimension_is_good, grid_is_good);
    if (read_contacts()) check_contact_of_transfer(root_, scene_);
    scene_.failed_updates_allowed = root_.whole_number("failed_updates_allowed");
    read_output();
    read_limits();
    root_.finish();
    return std::move(scene_);
  }

 private:
  std::size_t dimension() const { return static_cast<std::size_t>(scene_.grid.dimension); }

  static tasks::Triple triple(const std::vector<double>& numbers)
  {
    tasks::Triple t{0, 0, 0};
    std::copy(numbers.begin(), numbers.end(), t.begin());
    return t;
  }

  void read_dimension()
  {
    document_.dimension = scene_.grid.dimension = root_.whole_number("dimension");
    document_.axisymmetric = scene_.axisymmetric = root_.flag("axisymmetric");
    if (scene_.axisymmetric && dimension() != 2) {
      root_.add_problem("axisymmetric", "a scene of dimension 3", "expected one of dimension 2, the plane of r and z");
    }
  }

  void read_grid()
  {
    JsonReader reader = root_.object("grid");
    runtime::Grid& grid = scene_.grid;
    const std::size_t n_before = document_.problems.size();
    grid.lower = triple(reader.numbers("lower"));
    const std::vector<double> upper = reader.numbers("upper");
    grid.cell_size = reader.number("cell_size");
    const std::vector<int> patches = reader.whole_numbers("patches");
    reader.finish();
    if (document_.problems.size() > n_before) return;

    grid.n_cells = {1, 1, 1};
    scene_.n_patches = {1, 1, 1};
    for (std::size_t axis = 0; axis < dimension(); ++axis) {
      grid.n_cells[axis] = count_cells(reader, grid.lower[axis], upper[axis], axis);
      scene_.n_patches[axis] = patches[axis];
      check_patches(reader, patches[axis], grid.n_cells[axis], axis);
    }
    constexpr double most_patches = 1e5;
    const double n_patches = 1.0 * scene_.n_patches[0] * scene_.n_patches[1] * scene_.n_patches[2];
    if (n_patches > most_patches) {
      reader.add_problem("patches", fmt::format("{:.3g} in all", n_patches), "expected at most 100000");
    }
  }

  void check_patches(const JsonReader& reader, int n_patches, int n_cells, std::size_t axis) const
  {
    const int least_width = tasks::least_patch_width(scene_.interpolator);
    const std::string found = fmt::format("{} patches along {}", n_patches, "xyz"[axis]);
    if (n_cells % n_patches != 0) {
      reader.add_problem("patches", found, fmt::format("expected a number that divides the {} cells there", n_cells));
    } else if (n_patches > 1 && n_cells / n_patches < least_width) {
      reader.add_problem("patches", fmt::format("{}, {} cells wide", found, n_cells / n_patches),
                         fmt::format("expected patches at least {} cells wide along an axis that is cut", least_width));
    }
  }

  /// Cells along an axis, which must be a whole number of them.
  int count_cells(const JsonReader& reader, double lower, double upper, std::size_t axis) const
  {
    constexpr double most = 1e6;
    const double cells = (upper - lower) / scene_.grid.cell_size;
    const double whole = std::round(cells);
    if (!(whole >= 1 && whole <= most)) {
      reader.add_problem("upper", fmt::format("{} cells along {}", whole, "xyz"[axis]), "expected 1 to 1000000");
      return 1;
    }
    if (std::abs(cells - whole) > 1e-9 * whole) {
      const double next = lower + std::ceil(cells) * scene_.grid.cell_size;
      reader.add_problem("cell_size", fmt::format("{:.10g} cells along {}", cells, "xyz"[axis]),
                         fmt::format("expected a whole number of them, as with {:.8g} m in /grid/upper", next));
    }
    return static_cast<int>(whole);
  }

  void read_faces(bool grid_is_good)
  {
    JsonReader reader = root_.object("boundaries");
    for (std::size_t axis = 0; axis < dimension(); ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        const std::string key{"xyz"[axis], "-+"[side]};
        scene_.faces[axis][side] = read_kind<tasks::Face>(reader, key, reader.choice<int>(key));
      }
      read_periodic(reader, axis, grid_is_good);
    }
    reader.finish();
  }

  void read_periodic(JsonReader& reader, std::size_t axis, bool grid_is_good)
  {
    const std::array<std::string, 2> keys{std::string{"xyz"[axis], '-'}, std::string{"xyz"[axis], '+'}};
    const auto is_periodic = [&](std::size_t side) {
      return components::traits_of(scene_.faces[axis][side]).beyond == components::Beyond::opposite;
    };
    const bool lower = is_periodic(0), upper = is_periodic(1);
    if (lower != upper) {
      reader.add_problem(lower ? keys[1] : keys[0], "a face that is not periodic, opposite to one that is",
                         "expected both faces of an axis periodic, or neither");
    }
    if (!lower || !upper) return;
    scene_.grid.periodic[axis] = true;
    const int n_cells = scene_.grid.n_cells[axis], least = tasks::least_patch_width(scene_.interpolator);
    if (grid_is_good && n_cells < least) {
      reader.add_problem(keys[0], fmt::format("periodic, {} cells along {}", n_cells, "xyz"[axis]),
                         fmt::format("expected at least {} cells between periodic faces", least));
    }
  }

  void read_time()
  {
    JsonReader reader = root_.object("time");
    tasks::SceneTime& time = scene_.time;
    read_parameters(reader, time);
    time.rule = reader.choice<tasks::StepRule>("rule");
    if (time.maximum_step < time.minimum_step) {
      reader.add_problem("maximum_step", fmt::format("{}", time.maximum_step),
                         fmt::format("expected no less than the minimum step, {}", time.minimum_step));
    }
    reader.finish();
  }

  void read_transfer()
  {
    scene_.transfer = root_.choice<tasks::Transfer>("transfer");
    for (const auto& number : components::TransferNumbers::parameters()) {
      if (goes_with_transfer(number.key)) read_parameter(number, root_, scene_.transfer_numbers);
    }
  }

  /// Whether the scene's transfer has this number; if the key is there and it has not, that is noted.
  bool goes_with_transfer(std::string_view number)
  {
    std::vector<std::string_view> owners;
    components::for_each_alternative<components::Transfers>([&]<class T>(std::type_identity<T>) {
      if constexpr (requires { T::own_key; }) {
        if (T::own_key == number) owners.push_back(T::word);
      }
    });
    if (std::find(owners.begin(), owners.end(), scene_.transfer.word()) != owners.end()) return true;
    const std::string key(number);
    if (root_.has(key)) {
      root_.add_problem(key, "a key that another transfer has",
                        fmt::format("expected the transfer {} with it", fmt::join(owners, " or ")));
    }
    return false;
  }

  void read_particles_per_cell()
  {
    const std::vector<int> n = root_.whole_numbers("particles_per_cell");
    scene_.particles_per_axis = n[0];
    if (std::any_of(n.begin(), n.end(), [&](int i) { return i != n[0]; })) {
      root_.add_problem("particles_per_cell", "unequal numbers", "expected the same number along every axis");
    }
  }

  void read_loads()
  {
    scene_.gravity = triple(root_.numbers("gravity"));
    read_centrifuge();
    read_artificial_viscosity();
    scene_.local_damping = root_.number("local_damping");
  }

  void read_centrifuge()
  {
    if (dimension() != 3) {
      if (root_.has("centrifuge")) root_.add_problem("centrifuge", "a plane scene", "expected one of dimension 3");
      return;
    }
    auto reader = root_.optional_object("centrifuge");
    if (!reader) return;
    if (scene_.is_periodic()) {
      root_.add_problem("centrifuge", "periodic boundaries, whose ends are not alike in a turning grid",
                        "expected other boundaries where the grid turns");
    }
    if (scene_.has_wall_to_leave()) {
      root_.add_problem("centrifuge", "a wall that can be left", "expected other boundaries where the grid turns");
    }
    const std::size_t n_before = document_.problems.size();
    const double speed = reader->number("angular_speed");
    const tasks::Triple axis = triple(reader->numbers("axis"));
    const tasks::Triple centre = triple(reader->numbers("centre"));
    const double acceleration = reader->number("angular_acceleration");
    reader->finish();
    if (document_.problems.size() > n_before) return;
    try {
      scene_.centrifuge.emplace(speed, tasks::vector_of<3>(axis), tasks::vector_of<3>(centre), acceleration);
    } catch (const components::BadValue& bad) {
      reader->add_problem("axis", bad.found, "expected " + bad.expected);
    }
  }

  void read_artificial_viscosity()
  {
    auto reader = root_.optional_object("artificial_viscosity");
    if (!reader) return;
    read_parameters(*reader, scene_.artificial_viscosity.emplace());
    reader->finish();
  }

  /// Do the entries of an object fit into the fields of a step? Each material has its own there, and each body its
  /// sums.
  bool has_room_for(const std::string& key)
  {
    constexpr std::size_t most = tasks::ParticleReport::max_entries;
    const std::size_t n = root_.members_of(key).size();
    if (n > most) root_.add_problem(key, fmt::format("{} entries", n), fmt::format("expected at most {}", most));
    return n <= most;
  }

  void read_materials()
  {
    if (!has_room_for("materials")) return;
    const auto words = keys_of_kinds<components::ContactNormal>().words;
    for (const std::string& name : root_.members_of("materials")) {
      // "solid" came later than scenes with a material of that name, which keeps its meaning.
      const bool is_word = std::ranges::any_of(words, [&](const auto& word) { return word.word == name; });
      if (is_word && name != components::SolidNormal::word) {
        document_.add_problem(root_.pointer("materials") / name, "a word of the contact key normal",
                              "expected another name");
      }
      document_.merge_file_named_at(root_.pointer("materials") / name, material_keys());
    }
    for (auto& [name, reader] : root_.members("materials")) {
      material_names_.push_back(name);
      auto material = read_material(name, std::move(reader), dimension() == 2 && !scene_.axisymmetric);
      if (material) scene_.materials.push_back(std::move(*material));
    }
  }

  void read_bodies(bool dimension_is_good, bool grid_is_good)
  {
    const std::size_t n_before = document_.problems.size();
    if (!has_room_for("bodies")) return;
    auto members = root_.members("bodies");
    // Every place would have the wrong number of coordinates, and every material a wrong name.
    if (!dimension_is_good || material_names_.empty()) return;
    for (auto& [name, reader] : members) {
      auto body = read_body(name, std::move(reader), scene_, material_names_, grid_is_good);
      if (body) scene_.bodies.push_back(std::move(*body));
    }
    if (!grid_is_good || document_.problems.size() > n_before) return;
    check_no_overlap(scene_, root_.object("bodies"));
    check_rigid_bodies(scene_, root_.object("bodies"));
    if (document_.problems.size() == n_before) check_settled_bodies(scene_, root_.object("bodies"));
    if (scene_.axisymmetric) check_axisymmetric_bodies(scene_, root_.object("bodies"));
    check_mirrored_bodies(scene_, root_);
  }

  int material_number(const std::string& name) const
  {
    const auto at = std::find(material_names_.begin(), material_names_.end(), name);
    return at == material_names_.end() ? -1 : static_cast<int>(at - material_names_.begin());
  }

  /// Whether all is well with them, and with what they are between.
  bool read_contacts()
  {
    const std::size_t n_before = document_.problems.size();
    for (JsonReader& reader : root_.objects("contact")) {
      const std::vector<std::string> names = reader.names("materials", material_names_);
      const double friction = reader.number("friction");
      const components::ContactNormal normal = read_normal(reader, names);
      reader.finish();
      if (names.empty()) continue;
      const int a = material_number(names[0]), b = material_number(names[1]);
      if (a == b) {
        reader.add_problem("materials", fmt::format("\"{}\" twice", names[0]), "expected two different materials");
      } else if (is_listed(a, b)) {
        reader.add_problem("materials", "a pair that is listed before", "expected every pair once");
      }
      scene_.contacts.push_back({a, b, friction, normal});
      check_solid(reader, scene_, scene_.contacts.back());
    }
    if (!scene_.is_periodic()) add_other_contacts();
    return document_.problems.size() == n_before && scene_.materials.size() == material_names_.size();
  }

  bool is_listed(int a, int b) const
  {
    return std::any_of(scene_.contacts.begin(), scene_.contacts.end(), [&](const tasks::SceneContact& c) {
      return std::minmax(c.material_a, c.material_b) == std::minmax(a, b);
    });
  }

  /// Strata of ground touch from the start. With splines the planes of regression see a gap there, which would close.
  bool is_flatter_usual(int a, int b) const { return scene_.is_periodic() || tasks::are_strata(scene_, a, b); }

  /// Pairs that are not listed slide freely, with normals like those of others.
  void add_other_contacts()
  {
    const int n = static_cast<int>(scene_.materials.size());
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        if (is_listed(a, b)) continue;
        scene_.contacts.push_back({a, b, 0, components::RegressionNormal()});
        if (is_flatter_usual(a, b)) scene_.contacts.back().normal = components::FlatterNormal();
      }
    }
  }

  /// By its word or its parameters, or the name of one of the two materials.
  components::ContactNormal read_normal(JsonReader& reader, const std::vector<std::string>& materials) const
  {
    using components::ContactNormal;
    std::optional<int> place = reader.value_of_object("normal");
    ContactNormal normal;
    if (!place) {
      const auto number = [&](std::size_t i) { return materials.empty() ? -1 : material_number(materials[i]); };
      const std::string_view usual =
          is_flatter_usual(number(0), number(1)) ? components::FlatterNormal::word : components::RegressionNormal::word;
      const std::string name = reader.name("normal", materials, std::string(usual));
      normal = components::OwnNormal{material_number(name)};
      const bool is_material = std::find(materials.begin(), materials.end(), name) != materials.end();
      for (const auto& word : keys_of_kinds<ContactNormal>().words) {
        if (word.word == name && !is_material) place = word.value;
      }
    }
    if (place) normal = read_kind<ContactNormal>(reader, "normal", *place);
    if (!components::acts_apart(normal) && scene_.is_periodic()) {
      reader.add_problem("normal",
                         std::holds_alternative<components::SolidNormal>(normal)
                             ? "solid, whose place is one, between periodic boundaries"
                             : "regression, whose planes have one place each, between periodic boundaries",
                         "expected another normal");
    }
    return normal;
  }

  void read_output()
  {
    JsonReader reader = root_.object("output");
    scene_.output.fields_interval = read_interval(reader, "fields_interval", usual_field_outputs, 1e5);
    scene_.output.history_interval = read_interval(reader, "history_interval", usual_history_rows, 1e7);
    scene_.output.near_nose = reader.number("near_nose");
    read_fields(reader);
    reader.finish();
  }

  /// The fields of all materials and of the nodes.
  void read_fields(JsonReader& reader)
  {
    // Nobody knows what the fields of a bad material are.
    if (scene_.materials.size() != material_names_.size()) return;
    std::vector<std::string> known;
    const auto add = [&](const tasks::FieldName& field) {
      if (std::find(known.begin(), known.end(), field.name) == known.end()) known.push_back(field.name);
    };
    for (int material = 0; material < static_cast<int>(scene_.materials.size()); ++material) {
      for (const tasks::FieldName& field : tasks::particle_field_names(scene_, material)) add(field);
    }
    for (const tasks::FieldName& field : tasks::node_field_names()) add(field);
    scene_.output.fields.names = reader.some_of("fields", known);
  }

  /// Reads the interval between outputs; by default there are `n` of them, and at most `most`.
  double read_interval(JsonReader& reader, const std::string& key, double n, double most)
  {
    const double end = scene_.time.end;
    const double interval = reader.number(key, end / n);
    if (end / interval > most) {
      reader.add_problem(key, fmt::format("{:.3g} outputs until the end, {} s", end / interval, end),
                         fmt::format("expected at most {:.3g}", most));
    }
    return interval;
  }

  void read_limits()
  {
    JsonReader reader = root_.object("limits");
    scene_.limits.energy_error =
        reader.has_word("energy_error") ? std::numeric_limits<double>::infinity() : reader.number("energy_error");
    read_parameters(reader, scene_.limits);
    reader.finish();
  }

  Document& document_;
  JsonReader root_;
  tasks::Scene scene_{};
  std::vector<std::string> material_names_;
};

}  // namespace

CheckedScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& assignments)
{
  Document document(file, scene_keys());
  document.merge_file_named_at(JsonPointer(), scene_keys());
  for (const std::string& assignment : assignments) document.set(assignment);
  tasks::Scene scene = SceneReader(document).read();
  if (!document.problems.empty()) throw InputError(std::move(document.problems));
  document.root["inputs"] = to_json(document.inputs);
  return {std::move(scene),           std::move(document.root),     std::move(document.inputs),
          std::move(document.notes),  std::move(document.left_out), std::move(document.warnings),
          std::move(document.remarks)};
}

}  // namespace tamp::tools
