#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tamp::runtime
{

/// Writes a table of numbers row by row, each row complete in the file when `write_row` returns, so that an interrupted
/// run leaves a readable table. Numbers are written with as many digits as it takes to read the same number back.
class CsvWriter
{
 public:
  /// Starts the file anew with a first row that names the columns, such as `time[s]`. Throws FileError.
  CsvWriter(const std::filesystem::path& file, const std::vector<std::string>& columns);

  /// Goes on with the table of a run that is resumed after `last_step`: keeps the rows whose first column, the step, is
  /// no later. Starts it anew where there is none. Throws FileError, for a table of other columns too.
  static CsvWriter continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                             std::int64_t last_step);

  /// As many values as there are columns. Throws FileError, for a full disk too.
  void write_row(std::span<const double> values);

  std::size_t n_columns() const { return n_columns_; }

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  CsvWriter(const std::filesystem::path& file, std::size_t n_columns, const char* mode);
  void write_line(const std::string& line);

  std::filesystem::path file_;
  std::size_t n_columns_;
  std::unique_ptr<std::FILE, Close> stream_;
};

}  // namespace tamp::runtime
