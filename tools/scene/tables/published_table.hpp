#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/scene/tables/table.hpp"

namespace tamp::tools
{

/// A table in the JSON layout published with the Vaango code, {"Vaango_tabular_data": {"Data": DATA}}. DATA is either a
/// curve, lists of equal length under their names, or a level: {NAME: [one number for each], "Data": [DATA of each]}.
/// SI units; strains and pressures are compression positive.
struct PublishedTable {
  struct Level {
    std::string name;
    std::size_t n_entries;
  };
  struct Curve {
    std::string place;       ///< FILE#/json/pointer of the object that holds the lists
    std::vector<double> at;  ///< the number of each level
    std::map<std::string, std::vector<double>> lists;

    /// Where item `row` of a list stands.
    std::string place_of(const std::string& name, std::ptrdiff_t row) const;
  };

  std::filesystem::path file;
  std::vector<Level> levels;  ///< outermost first
  std::vector<Curve> curves;

  /// Every name in it, with the number of entries of each level.
  std::string names() const;
  /// Place of a level; the number of levels if there is none of this name.
  std::size_t level(const std::string& name) const;
  /// Is each level but `name`'s of one entry, so that it can be left out of account?
  bool depends_on_no_level_but(const std::string& name) const;
  /// The problem of a file that holds something else than was asked for.
  Problem unsuitable(const std::string& expected) const;
};

/// Throws FileError if the file cannot be read, and InputError, with file and JSON pointer, for another layout, for
/// what is not a number, lists whose lengths differ, and curves of fewer than two points.
PublishedTable read_published_table(const std::filesystem::path& file);

/// The name under which a column such as `pressure[Pa]` is published; empty if it never is.
std::string published_name(const std::string& column);

/// The columns asked for of a published table that is one curve. Throws as read_published_table, and InputError for
/// other names and for a table of more variables, unless the others have one entry.
Table read_published_curve(const std::filesystem::path& file, const std::vector<std::string>& columns);

}  // namespace tamp::tools
