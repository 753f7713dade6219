#include "runtime/storage/csv_writer.hpp"
#include "tests/fuzz/readers.hpp"
#include "tools/study/point_results.hpp"

namespace
{

namespace fs = std::filesystem;

/// In a folder of its own, as what a restart sets aside is to go.
struct RunFolder {
  explicit RunFolder(const fs::path& file) : path(file.string() + ".run")
  {
    fs::create_directory(path);
    fs::copy_file(file, path / "history.csv");
  }
  ~RunFolder() { fs::remove_all(path); }

  fs::path path;
};

}  // namespace

void tamp::fuzz::history(const std::filesystem::path& file)
{
  const RunFolder run(file);
  runtime::CsvWriter::continued(run.path / "history.csv", {"step", "time[s]", "kinetic[J]"}, 10, {2, 0});
  fs::copy_file(file, run.path / "history.csv", fs::copy_options::overwrite_existing);
  tools::study::PointResult result;
  result.folder = run.path;
  result.columns();
}
