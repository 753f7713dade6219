#pragma once

#include <filesystem>

namespace tamp::tools
{

enum class FileKind { json, hdf5, text };

/// The kind of a file, by its ending (.json, .h5, .hdf5, .keras) or else by how it begins; otherwise text. Throws
/// FileError if it cannot be read.
FileKind file_kind(const std::filesystem::path& file);

}  // namespace tamp::tools
