#pragma once

#include <filesystem>

namespace tamp::tools
{

/// Throws InputError where `page.json` or the page would replace one of the files of the run that it is drawn from, and
/// FileError where it cannot be written.
void expect_page(const std::filesystem::path& run);

/// Writes `page.json`, what the drawing of a run's page needs of files that Python does not read by itself: the
/// materials of a scene by name, pictures of it, and the words that it chose, with their meanings. Where the fields are
/// damaged it says so under `no_pictures`. Throws FileError where another file of the run is missing or damaged, or
/// `page.json` cannot be written.
void write_page_data(const std::filesystem::path& run);

}  // namespace tamp::tools
