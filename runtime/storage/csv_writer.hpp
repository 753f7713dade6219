#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/storage/file_state.hpp"

namespace tamp::runtime
{

/// How much of a table there is: its rows, and a hash of its header and of them.
struct CsvExtent {
  std::int64_t n_rows = 0;
  std::uint64_t hash = 0;

  bool operator==(const CsvExtent&) const = default;
};

/// Writes a table of numbers row by row, each row complete in the file when `write_row` returns, so that an interrupted
/// run leaves a readable table. Numbers are written with as many digits as it takes to read the same number back.
class CsvWriter
{
 public:
  /// Starts the file anew with a first row that names the columns, such as `time[s]`. Throws FileError.
  CsvWriter(const std::filesystem::path& file, const std::vector<std::string>& columns);

  /// Goes on with the table of a run that is resumed after `last_step`: keeps the rows whose first column, the step, is
  /// no later. They should be what `expected` tells; where they are not, those that can be read stay, the file as it
  /// was is set aside as FILE.damaged, and `notice` says so. Throws FileError.
  static CsvWriter continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                             std::int64_t last_step, const CsvExtent& expected);
  /// Continues a table whose extent is not known: its readable rows stay, without a notice.
  static CsvWriter continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                             std::int64_t last_step);

  /// Writes a row of as many values as there are columns. Throws FileError, for a full disk too.
  void write_row(std::span<const double> values);

  std::size_t n_columns() const { return n_columns_; }
  /// Throws FileError if the file is no longer there as it was written: removed, replaced or emptied by someone else.
  void expect_as_written() const;
  /// The extent of the file now.
  const CsvExtent& extent() const { return extent_; }
  /// A notice for the user on the table that was to be continued; empty if all was well.
  const std::string& notice() const { return notice_; }

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  /// Replaces the file by lines with so many columns, of this extent.
  CsvWriter(const std::filesystem::path& file, const std::string& lines, std::size_t n_columns,
            const CsvExtent& extent);
  static CsvWriter continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                             std::int64_t last_step, const CsvExtent* expected);
  void write_line(const std::string& line);

  std::filesystem::path file_;
  std::size_t n_columns_;
  std::unique_ptr<std::FILE, Close> stream_;
  CsvExtent extent_;
  /// State of the file after the last row.
  FileState state_;
  std::string notice_;
};

}  // namespace tamp::runtime
