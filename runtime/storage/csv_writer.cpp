#include "runtime/storage/csv_writer.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "runtime/storage/file_error.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

std::string line_of(const auto& values)
{
  return fmt::format("{}\n", fmt::join(values, ","));
}

/// The first line and the rows up to `last_step`; what follows the last end of a line was cut off by a program's end.
std::string kept_of(const std::filesystem::path& file, const std::string& header, std::int64_t last_step)
{
  if (!std::filesystem::exists(file)) return header;
  std::ifstream stream(file);
  std::string kept, line;
  while (std::getline(stream, line) && !stream.eof()) {
    line += '\n';
    if (kept.empty() && line != header) throw FileError(file.string(), "has other columns than this run writes");
    if (kept.empty() || std::strtod(line.c_str(), nullptr) <= static_cast<double>(last_step)) kept += line;
  }
  if (stream.bad()) throw FileError(file.string(), "cannot be read");
  return kept.empty() ? header : kept;
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& file, std::size_t n_columns, const char* mode)
    : file_(file), n_columns_(n_columns), stream_(std::fopen(file.c_str(), mode))
{
  if (!stream_) throw FileError(file_.string(), std::strerror(errno));
}

CsvWriter::CsvWriter(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : CsvWriter(file, columns.size(), "wb")
{
  write_line(line_of(columns));
}

CsvWriter CsvWriter::continued(const std::filesystem::path& file, const std::vector<std::string>& columns,
                               std::int64_t last_step)
{
  write_whole_file(file, kept_of(file, line_of(columns), last_step));
  return CsvWriter(file, columns.size(), "ab");
}

void CsvWriter::write_row(std::span<const double> values)
{
  if (values.size() != n_columns_) {
    throw std::invalid_argument(fmt::format("{} values for {} columns", values.size(), n_columns_));
  }
  write_line(line_of(values));
}

void CsvWriter::write_line(const std::string& line)
{
  const bool written = std::fwrite(line.data(), 1, line.size(), stream_.get()) == line.size();
  if (!written || std::fflush(stream_.get()) != 0) throw FileError(file_.string(), std::strerror(errno));
}

}  // namespace tamp::runtime
