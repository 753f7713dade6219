#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tamp::tools
{

/// More than any file of a scene needs, and little enough to be read at once [bytes].
inline constexpr std::uintmax_t most_input_bytes = std::uintmax_t{1} << 28;

/// Throws InputError for a file that is not there, and for what can be read without an end or is too large: a folder, a
/// device, a pipe, a file of more than `most_input_bytes`; FileError for one that cannot be read.
void expect_input_file(const std::filesystem::path& file);

/// The content of such a file.
std::string read_input_file(const std::filesystem::path& file);

/// Reads a text, without the mark of its bytes' order that some programs put before UTF-8.
std::string read_input_text(const std::filesystem::path& file);

/// The text behind that mark, if it is there.
std::string_view without_byte_order_mark(std::string_view text);

/// Notes a file that is read by other means, if it is there.
void note_input(const std::filesystem::path& file);

/// Notes all that comes with the program: of this its benchmarks and its catalogues of studies are made.
void note_shipped_inputs();

/// Whether this is a file that the program has read by the functions above or noted, under whatever name.
bool is_input(const std::filesystem::path& file);

/// A file that a scene names.
struct InputFile {
  /// The pointer of the key that names it in the resolved scene; empty for the scene itself and what is merged into it.
  std::string pointer;
  std::filesystem::path file;
  /// Hash of its content, 16 hexadecimal digits; empty for a file that is not read, such as one of a model not used.
  std::string hash;
};

/// The hash of a text, as 16 hexadecimal digits. A file's is that of its content.
std::string hash_of(const std::string& text);

}  // namespace tamp::tools
