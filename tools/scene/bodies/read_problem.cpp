#include "tools/scene/bodies/read_problem.hpp"

#include "components/errors.hpp"
#include "tasks/method.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tasks/set_up/deformed_start.hpp"
#include "tools/scene/json/parameter_keys.hpp"
#include "tools/scene/json/place_text.hpp"

namespace tamp::tools
{

namespace
{

const std::string problem_key = "problem";

/// The problem of this type, if it is `P`.
template <class P>
void read_if(const std::string& type, JsonReader& reader, std::optional<components::Problem>& found)
{
  if (type != P::type) return;
  P problem{};
  read_parameters(reader, problem);
  found = problem;
}

template <class... P>
std::optional<components::Problem> read_one_of(const std::variant<P...>*, const std::string& type, JsonReader& reader)
{
  std::optional<components::Problem> found;
  (read_if<P>(type, reader, found), ...);
  return found;
}

/// Do the particles of a layout lie in the body, others where the functions hold, and do all start within the grid,
/// none turned inside out?
template <int D>
void check_places(const tasks::Scene& scene, const tasks::SceneBody& body, const JsonReader& reader)
{
  const components::BodyFunctions& functions = body.functions;
  const auto& solid = std::get<components::Solid<D>>(body.solid);
  components::Box<D> grid{tasks::vector_of<D>(scene.grid.lower), {}};
  for (int k = 0; k < D; ++k) {
    grid.upper[k] = scene.grid.coordinate(k, scene.grid.n_cells[static_cast<std::size_t>(k)]);
  }
  for (const Vector<D>& X : tasks::sites_of<D>(scene, body)) {
    if (functions.layout && !solid.contains(X)) {
      reader.add_problem(problem_key, "a particle at " + text<D>(X), "expected all of them within the body's geometry");
      return;
    }
    const Vector<3> in_space = tasks::in_space<D>(X);
    if (functions.holds && !functions.holds(in_space)) {
      reader.add_problem("geometry", "a particle at " + text<D>(X), "expected all of them where the problem is set");
      return;
    }
    if (!functions.displacement) continue;
    const Vector<D> x = X + functions.displacement(in_space).template head<D>();
    if (!((x - grid.lower).minCoeff() >= 0 && (grid.upper - x).minCoeff() > 0)) {
      reader.add_problem(problem_key, fmt::format("the particle of {} starts at {}", text<D>(X), text<D>(x)),
                         "expected a place within the grid");
      return;
    }
    if (!(functions.deformation_gradient(in_space).determinant() > 0)) {
      reader.add_problem(problem_key, fmt::format("the particle of {} starts turned inside out", text<D>(X)),
                         "expected a deformation gradient whose determinant is above 0");
      return;
    }
  }
}

}  // namespace

std::optional<components::Problem> read_problem(JsonReader& body)
{
  auto reader = body.optional_object(problem_key);
  if (!reader) return std::nullopt;
  const std::size_t n_before = reader->document().problems.size();
  const auto problem = read_one_of(static_cast<const components::Problem*>(nullptr), reader->type(), *reader);
  if (problem) reader->finish();
  if (reader->document().problems.size() > n_before) return std::nullopt;
  return problem;
}

std::optional<components::BodyFunctions> functions_of(const components::Problem& problem, const JsonReader& body,
                                                      const tasks::Scene& scene, const tasks::SceneMaterial& material)
{
  const components::ProblemBody given{scene.grid.dimension, material.density, material.model, scene.axisymmetric};
  try {
    return std::visit(
        [&]<class P>(const P& p) {
          if constexpr (!requires { p.spherical; }) {
            if (given.axisymmetric) throw components::BadValue("an axisymmetric scene", "one of plane strain or space");
          }
          return p.functions(given);
        },
        problem);
  } catch (const components::BadParameter& bad) {
    body.document().add_problem(body.pointer(problem_key) / bad.key, bad.found, "expected " + bad.expected);
  } catch (const components::BadValue& bad) {
    body.add_problem(problem_key, bad.found, "expected " + bad.expected);
  }
  return std::nullopt;
}

template <int D>
void check_functions(const tasks::Scene& scene, const tasks::SceneBody& body, const JsonReader& reader)
{
  constexpr tasks::Triple zero{0, 0, 0};
  const components::BodyFunctions& functions = body.functions;
  const bool moves = body.velocity != zero || body.angular_velocity != zero;
  if (body.rigid) reader.add_problem(problem_key, "a rigid body's", "expected that of a body that is not rigid");
  if (body.initial_stress) {
    reader.add_problem(problem_key, "that of a body that starts settled", "expected either it or initial_stress");
  }
  if (functions.velocity && moves) {
    reader.add_problem(problem_key, "that of a body with a velocity", "expected the velocity of the problem alone");
  }
  if (functions.exact_displacement && (scene.gravity != zero || scene.centrifuge)) {
    reader.add_problem(problem_key, "an exact solution in a scene with gravity or a centrifuge",
                       "expected the problem's own loads alone");
  }
  const auto& material = scene.materials[static_cast<std::size_t>(body.material)];
  if (functions.deformation_gradient && !tasks::may_start_deformed(material.model)) {
    reader.add_problem(problem_key, "a body that starts deformed, of material \"" + material.name + "\"",
                       "expected one whose stress follows from its shape, such as neo_hookean");
  }
  check_places<D>(scene, body, reader);
}

template void check_functions<2>(const tasks::Scene&, const tasks::SceneBody&, const JsonReader&);
template void check_functions<3>(const tasks::Scene&, const tasks::SceneBody&, const JsonReader&);

}  // namespace tamp::tools
