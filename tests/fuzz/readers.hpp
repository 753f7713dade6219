#pragma once

#include <filesystem>

/// Each reads a file as the program does, whatever is in it. InputError and FileError are sound answers, and so is
/// none; all else is a fault of the reader.
namespace tamp::fuzz
{

/// A scene with all that it names: `inputs/...` leads to shipped files, `corpus/...` to inputs of other readers.
void scene(const std::filesystem::path& file);
/// A study, in full and in short.
void study(const std::filesystem::path& file);
/// The `profile.json` of a run.
void profile(const std::filesystem::path& file);
/// The `history.csv` of a run, as a study and as a restart read it.
void history(const std::filesystem::path& file);
/// The `result.json` of a study's point, in a folder of its own. Its checksum is mended before it is read, or none but
/// that of the seed would ever be read further.
void result(const std::filesystem::path& file);
/// The `run.lock` of a folder, touched now and two minutes ago.
void run_lock(const std::filesystem::path& file);

/// Tables, in text or published.
void csv_table(const std::filesystem::path& file);
void yield_table(const std::filesystem::path& file);
void unloading_curves(const std::filesystem::path& file);
void published_table(const std::filesystem::path& file);
/// Reads the paths of `tamp drive` and `tamp modulus --states`.
void path(const std::filesystem::path& file);
void modulus_states(const std::filesystem::path& file);

/// Models of a modulus.
void support_vectors(const std::filesystem::path& file);
void network(const std::filesystem::path& file);

/// A triangle mesh in STL, binary or text.
void mesh(const std::filesystem::path& file);

/// A checkpoint, as it stands, and as one whose values are changed as the file says, a line for each change:
/// `NAME INDEX VALUE`.
void checkpoint(const std::filesystem::path& file);

}  // namespace tamp::fuzz
