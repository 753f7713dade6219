#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tamp::tools
{

/// A drawing that the Python tools are to make.
struct Drawing {
  std::vector<std::string> words;  ///< the words of their command line
  std::vector<std::string> later;  ///< the same words for drawing it another time
  std::filesystem::path place;     ///< the place that messages name
};

/// Has the Python tools draw. The interpreter is $TAMP_PYTHON where that is set, or else the first of /usr/bin/python3
/// and python3 that has matplotlib. Throws FileError, which says what to install and how to draw later; to be called
/// after all figures are written.
void draw(const Drawing& drawing);

/// Has the Python tools draw a picture of what they themselves read and judge, by the words of their command line. What
/// they refuse is an InputError with their message, and a file that is damaged or cannot be read or written, or a want
/// of Python with matplotlib, a FileError. Their warnings go to stderr.
void draw_from_inputs(const std::vector<std::string>& words, const std::filesystem::path& picture);

/// The same as `draw` for the study, the comparison or the run in a folder.
void draw_page(const std::filesystem::path& folder);

}  // namespace tamp::tools
