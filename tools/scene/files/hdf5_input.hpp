#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/storage/hdf5.hpp"

namespace tamp::tools
{

/// Numbers of a dataset, in C order, and its extents.
struct Hdf5Array {
  std::vector<std::size_t> extents;
  std::vector<double> numbers;
};

/// An HDF5 file that a person gave. Throws FileError if it cannot be opened for reading, InputError, with file and
/// place in it, where what it holds is damaged or of another kind than asked for.
class Hdf5Input
{
 public:
  explicit Hdf5Input(const std::filesystem::path& file);

  /// FILE#/path/in/it
  std::string place(const std::string& object, const std::string& attribute = "") const;

  bool has_attribute(const std::string& object, const std::string& attribute) const;
  /// Strings, of fixed or variable length; a single one is a list of one.
  std::vector<std::string> texts(const std::string& object, const std::string& attribute) const;
  /// The numbers of an attribute; nothing without it.
  std::optional<std::vector<double>> numbers(const std::string& object, const std::string& attribute) const;
  /// A dataset of numbers of any precision, all finite.
  Hdf5Array dataset(const std::string& path) const;

 private:
  runtime::hdf5::Attribute open(const std::string& object, const std::string& attribute) const;

  std::filesystem::path file_;
  runtime::hdf5::Quiet quiet_;
  runtime::hdf5::File id_;
};

}  // namespace tamp::tools
