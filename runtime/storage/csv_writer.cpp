#include "runtime/storage/csv_writer.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "runtime/storage/file_error.hpp"

namespace tamp::runtime
{

CsvWriter::CsvWriter(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : file_(file), n_columns_(columns.size()), stream_(std::fopen(file.c_str(), "wb"))
{
  if (!stream_) throw FileError(file_.string(), std::strerror(errno));
  write_line(fmt::format("{}\n", fmt::join(columns, ",")));
}

void CsvWriter::write_row(std::span<const double> values)
{
  if (values.size() != n_columns_) {
    throw std::invalid_argument(fmt::format("{} values for {} columns", values.size(), n_columns_));
  }
  write_line(fmt::format("{}\n", fmt::join(values, ",")));
}

void CsvWriter::write_line(const std::string& line)
{
  const bool written = std::fwrite(line.data(), 1, line.size(), stream_.get()) == line.size();
  if (!written || std::fflush(stream_.get()) != 0) throw FileError(file_.string(), std::strerror(errno));
}

}  // namespace tamp::runtime
