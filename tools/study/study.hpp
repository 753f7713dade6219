#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/scene/json/document.hpp"

/// Content of a study file: what is measured, with which settings, and against what.
namespace tamp::tools::study
{

/// Values at JSON pointers of what is measured, in the order in which they are set; each pointer once.
using Settings = std::vector<std::pair<std::string, Json>>;

/// The command that a point runs.
struct Measure {
  enum class Kind {
    run,     ///< a scene, by `tamp run`
    drive,   ///< a material along a path, by `tamp drive`
    modulus  ///< a material's modulus at given states, by `tamp modulus`
  };
  Kind kind = Kind::run;
  /// The scene or the material.
  std::filesystem::path file;
  /// The path of deformation, or the states.
  std::filesystem::path along;
  /// Largest strain of an increment along a path.
  double increment = 1e-3;
};

/// Values of one pointer, from coarse to fine where they refine something.
struct Axis {
  std::string pointer;
  std::vector<Json> values;
};

/// A line of the charts.
struct Method {
  std::string name;
  /// Methods of one family share a colour.
  std::string family;
  bool dashed = false;
  Settings settings;
  /// Its points are all combinations of these, and those that are listed besides.
  std::vector<Axis> sweep;
  std::vector<Settings> listed;
  /// Whether it models something else than the reference does, so that its difference is no error.
  bool another_model = false;
};

/// How a number is taken from what a point has written.
enum class Take {
  greatest,
  least,
  last,
  value,             ///< at a time
  mean,              ///< mean of all rows from a time on
  farthest,          ///< the row farthest from the exact answer
  kept,              ///< the last over the first
  time_of_greatest,  ///< from the parabola through the three rows around it
  curve,             ///< over time: greatest difference from the reference's, over its greatest magnitude
  rows_rms,          ///< root mean square over the rows of the difference relative to the reference's row
  rows_max,          ///< the greatest of these differences
  quantile,          ///< of a field over a material's particles, at the last output
  field_rms          ///< the same way, root mean square of the field's difference from a line
};

/// A quantity that is evaluated for each point.
struct Quantity {
  std::string name;
  Take take = Take::last;
  std::string column;
  /// Columns that are added to it.
  std::vector<std::string> plus{};
  /// Where the value is taken, or the first of those whose mean is [s].
  double time = 0;
  std::string field{}, material{};
  /// JSON pointer to a number of the summary, which is taken instead of a column; empty for none.
  std::string summary{};
  /// Component of a field of vectors: 0, 1 or 2; empty for a field of numbers.
  std::optional<int> component{};
  double quantile = 0.99;
  /// Expected value of the field at the origin, and its slope along each axis [1/m].
  std::vector<double> line{};
  /// The exact answer, if it is known.
  std::optional<double> exact{};
  /// Scale of relative errors, where that is not the reference.
  std::optional<double> scale{};

  /// Whether a point's answer is a column, which only a reference makes a number.
  bool is_column() const { return take == Take::curve || take == Take::rows_rms || take == Take::rows_max; }
  /// Whether it is taken from particles instead of from a column.
  bool is_of_field() const { return take == Take::quantile || take == Take::field_rms; }
  bool is_of_summary() const { return !summary.empty(); }
};

/// Reference of points where no exact answer is known: one run, or, where `refinement` has values, the limit
/// that its runs tend to.
struct ReferenceRuns {
  Settings settings{};
  Axis refinement{};
  /// Whether each method is compared with runs that have its own settings besides: of methods that tend to different
  /// answers.
  bool of_each_method = false;
  /// Other forms that have as good a claim, over these settings on the finest grid: how far they are from the reference
  /// is the least that it is uncertain by.
  std::vector<Settings> beside{};
};

/// A source of error: what it changes, in one way or several.
struct BudgetPart {
  std::string name;
  /// The distance from the reference instead of from a changed run.
  bool to_reference = false;
  std::vector<Settings> variations;
};

/// The settings whose error is to be found.
struct BudgetBase {
  std::string name;
  Settings settings;
};

struct Budget {
  std::vector<std::string> quantities;
  std::vector<BudgetBase> bases;
  std::vector<BudgetPart> parts;
};

/// Expectation of some methods' results, stated before they run.
struct Expectation {
  enum class Kind {
    order_at_least,
    order_at_most,
    error_at_least,  ///< on the finest grid, or where `at` says
    error_at_most,
    limit_error_at_most,  ///< error of the limit of the answers, if errors fall with `limit_order`
    fails                 ///< becomes unstable, or its error grows again by half to the finest grid
  };
  Kind kind = Kind::error_at_most;
  /// An order, or an error.
  double limit = 0;
  std::string quantity;
  std::vector<std::string> methods;
  /// For people.
  std::string why;
  /// The value of the refined setting whose error is judged; empty: the finest.
  std::optional<double> at{};
  double limit_order = 1;
  /// Methods that are known to miss it, and why.
  std::map<std::string, std::string> missed{};
};

/// A failure that a study shows: one method that has it, and one that has not.
struct Stability {
  std::string quantity;
  /// An error too large to be one of accuracy. The method that fails has three times this error or becomes unstable,
  /// the one that survives at most a third of it.
  double threshold = 0;
  std::string fails, survives;
  /// For people: what is seen, and the number by which a run can tell.
  std::string symptom, monitor;
};

/// A sheet of a map: methods whose points have a row by one setting and a column by another.
struct MapSheet {
  std::string name;
  std::vector<std::string> methods;
  std::string rows, columns;
  /// The greatest value of the columns that theory allows.
  std::optional<double> bound{};
};

/// Where runs are stable, noisy or blown, by their distance from the reference.
struct StudyMap {
  std::string quantity;
  /// The least distances of each.
  double noisy = 0, blown = 0;
  std::vector<MapSheet> sheets;
};

/// The criterion of stability where the limit of a setting is looked for: a run is stable if it comes to its end, with
/// errors of the energy, and of a quantity whose answer is exact, that are no larger than these.
struct StableIf {
  std::optional<double> energy_error{};
  /// Empty for none.
  std::string quantity{};
  std::optional<double> error{};
};

struct Study {
  std::filesystem::path file;
  std::string title, about, takes;
  Measure measure;
  Settings settings;
  std::vector<Method> methods;
  /// The pointer along which errors should fall; empty for none.
  std::string refine;
  std::vector<Quantity> quantities;
  std::optional<ReferenceRuns> reference;
  std::optional<Budget> budget;
  std::vector<Expectation> expectations;
  /// The failure that the study shows, where it is an entry of the failure catalogue.
  std::optional<Stability> stability{};
  StableIf stable_if;
  std::optional<StudyMap> map;
  /// Timings of each point; of one that takes longer than `repeat_below` [s] only one.
  int repeat = 3;
  double repeat_below = 60;
  /// Processor time that a point may take [s], and that over the fastest point's.
  double limit = std::numeric_limits<double>::infinity();
  double limit_over_fastest = std::numeric_limits<double>::infinity();
  int n_threads = 1;
  /// A rehearsal: runs end after so many steps.
  std::optional<long> most_steps{};
};

/// Each is checked before the first runs, and is a process of its own.
inline constexpr double most_points = 1e4;

/// Reads a study's file, with its key `short` laid over the rest if `in_short`. Throws FileError if it cannot be read,
/// and InputError with every problem. Settings are not looked at (measurement.hpp does that).
Study read_study(const std::filesystem::path& file, bool in_short);

}  // namespace tamp::tools::study
