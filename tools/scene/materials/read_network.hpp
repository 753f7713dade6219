#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "components/moduli/network_fit.hpp"

namespace tamp::tools
{

/// The content of a Keras HDF5 file: a Sequential model, or a Functional one that is a chain, of Dense layers (linear,
/// relu, sigmoid, tanh, also as Activation layers of their own) from elastic and plastic volumetric strain to the bulk
/// modulus, and, where its maker added them as attributes of the root, what the three were standardised with and the
/// strains it was fitted over.
struct NetworkFile {
  std::vector<components::DenseLayer> layers;
  /// Attribute `scaling`: mean and deviation of the elastic strain, of the plastic strain, and of K.
  std::optional<std::vector<double>> scaling;
  /// Attribute `range`: least and most elastic strain, least and most plastic strain.
  std::optional<std::vector<double>> range;
};

/// Throws FileError if the file cannot be read, and InputError, with file and place in it, for anything else.
NetworkFile read_network_file(const std::filesystem::path& file);

/// Throw InputError, said with `place`, unless the numbers can be a network's `scaling` or `range`.
void check_scaling(const std::vector<double>& scaling, const std::string& place);
void check_range(const std::vector<double>& range, const std::string& place);

/// Where nothing is known: from zero to two deviations beyond the mean of either strain.
std::vector<double> likely_range(const std::vector<double>& scaling);

/// Scaling and range as above, checked.
components::NetworkFit network_fit(std::vector<components::DenseLayer> layers, const std::vector<double>& scaling,
                                   const std::vector<double>& range);

}  // namespace tamp::tools
