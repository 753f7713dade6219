#include "runtime/storage/csv_writer.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "runtime/file_error.hpp"
#include "runtime/storage/checksum.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

std::string line_of(const auto& values)
{
  return fmt::format("{}\n", fmt::join(values, ","));
}

/// The step of a row that holds a number for each column, and nothing else.
std::optional<double> step_of(const std::string& line, std::size_t n_columns)
{
  const char* at = line.c_str();
  std::optional<double> step;
  for (std::size_t i = 0; i < n_columns; ++i) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || *end != (i + 1 == n_columns ? '\n' : ',')) return std::nullopt;
    if (i == 0) step = value;
    at = end + 1;
  }
  return step;
}

std::uint64_t hash_of(const std::string& line, std::uint64_t before = 0)
{
  return checksum(std::as_bytes(std::span(line)), before);
}

/// Adds the rows up to `last_step` to the header in `kept`, if the file has that header. What follows the last end of a
/// line was cut off by a program's end.
void add_rows_of(const std::filesystem::path& file, std::size_t n_columns, std::int64_t last_step, std::string& kept,
                 CsvExtent& extent)
{
  std::ifstream stream(file);
  std::string line;
  if (std::getline(stream, line) && line + '\n' == kept) {
    while (std::getline(stream, line) && !stream.eof()) {
      line += '\n';
      const std::optional<double> step = step_of(line, n_columns);
      if (!step || *step > static_cast<double>(last_step)) continue;
      kept += line;
      extent = {extent.n_rows + 1, hash_of(line, extent.hash)};
    }
  }
  if (stream.bad()) throw FileError(file.string(), "cannot be read");
}

/// Keeps a file as it is under another name, and gives that.
std::filesystem::path set_aside(const std::filesystem::path& file)
{
  const std::filesystem::path aside = name_aside(file);
  std::error_code failed;
  std::filesystem::copy_file(file, aside, failed);
  if (failed) throw FileError(aside.string(), failed.message());
  return aside.filename();
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& file, const std::string& lines, std::size_t n_columns,
                     const CsvExtent& extent)
    : file_(file), n_columns_(n_columns), extent_(extent)
{
  write_whole_file(file, lines);
  // To append leaves no gap where someone else has emptied the file.
  stream_.reset(std::fopen(file.c_str(), "ab"));
  const auto state = stream_ ? state_of(fileno(stream_.get())) : std::nullopt;
  if (!state) throw FileError(file_.string(), std::strerror(errno));
  state_ = *state;
}

CsvWriter::CsvWriter(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : CsvWriter(file, line_of(columns), columns.size(), {0, hash_of(line_of(columns))})
{
}

CsvWriter CsvWriter::continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                               std::int64_t last_step, const CsvExtent& expected)
{
  return continued(file, columns, last_step, &expected);
}

CsvWriter CsvWriter::continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                               std::int64_t last_step)
{
  return continued(file, columns, last_step, nullptr);
}

CsvWriter CsvWriter::continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                               std::int64_t last_step, const CsvExtent* expected)
{
  expect_no_stream(file);
  const bool missing = !std::filesystem::exists(file);
  std::string kept = line_of(columns);
  CsvExtent extent{0, hash_of(kept)};
  if (!missing) add_rows_of(file, columns.size(), last_step, kept, extent);

  std::string notice;
  if (expected != nullptr && missing) {
    notice = fmt::format("{}: is missing, with the {} rows until step {}; it was begun anew", file.string(),
                         expected->n_rows, last_step);
  } else if (expected != nullptr && extent != *expected) {
    notice = fmt::format("{}: is damaged: of {} rows until step {}, {} can be read and were kept; as it was it is {}",
                         file.string(), expected->n_rows, last_step, extent.n_rows, set_aside(file).string());
  }
  CsvWriter table(file, kept, columns.size(), extent);
  table.notice_ = notice;
  return table;
}

void CsvWriter::write_row(std::span<const double> values)
{
  if (values.size() != n_columns_) {
    throw std::invalid_argument(fmt::format("{} values for {} columns", values.size(), n_columns_));
  }
  const std::string line = line_of(values);
  write_line(line);
  extent_ = {extent_.n_rows + 1, hash_of(line, extent_.hash)};
}

void CsvWriter::write_line(const std::string& line)
{
  const bool written = std::fwrite(line.data(), 1, line.size(), stream_.get()) == line.size();
  if (!written || std::fflush(stream_.get()) != 0) throw FileError(file_.string(), std::strerror(errno));
  state_.n_bytes += line.size();
}

void CsvWriter::expect_as_written() const
{
  expect_as_left(file_, state_);
}

}  // namespace tamp::runtime
