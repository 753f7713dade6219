#include "tools/run/drive/drive_page.hpp"

#include <fstream>
#include <iterator>

#include "runtime/file_error.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/system/charts.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

std::string drawn_page(const fs::path& page)
{
  std::ifstream stream(page, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad()) throw runtime::FileError(page.string(), "cannot be read");
  return text;
}

}  // namespace

void write_drive_page(const std::string& rows, const std::string& title, const fs::path& file)
{
  // Drawn aside: the file itself may be a pipe, and is written whole or not at all.
  const runtime::TemporaryFolder aside;
  const fs::path table = aside.path() / "rows.csv", page = aside.path() / "page.html";
  runtime::write_whole_file(table, rows);
  draw({{"drive-page", table.string(), page.string(), "--title=" + title},
        {"drive-page", "ROWS.csv", file.string()},
        file});
  write_output({"--plot", file}, drawn_page(page));
}

}  // namespace tamp::tools
