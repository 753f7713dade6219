#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "components/materials/tabular_cap.hpp"

namespace tamp::tools
{

/// States to ask an elastic model for, and what was measured there. Volumetric strains and pressures, compression
/// positive; Pa.
struct ModulusStates {
  std::vector<double> elastic, plastic;
  std::vector<double> pressure, bulk_modulus;  ///< measured; empty where nothing was

  std::size_t size() const { return elastic.size(); }
  bool measured() const { return !pressure.empty(); }
};

/// Reads a CSV with the columns `elastic_volumetric[-]` and `plastic_volumetric[-]`, and with `pressure[Pa]` and
/// `bulk_modulus[Pa]`, both above zero, where it tells what was measured. Throws InputError and FileError as
/// read_csv_table does.
ModulusStates read_modulus_states(const std::filesystem::path& file);

/// A model's answer in one state.
struct ModulusAnswer {
  double pressure, bulk_modulus, modulus_by_plastic;
  bool in_range;
};

/// In state form as the model has it. In rate form the pressure is the integral of K from no elastic strain to the
/// state's, at its plastic strain, and K is asked at that pressure; dK/d(plastic) is that of the state form.
ModulusAnswer answer_at(const components::Modulus& modulus, components::ElasticUpdate form, double elastic,
                        double plastic);

/// The names of the numbers of an answer.
std::string modulus_header();

/// A line of numbers for a state, G by its ratio to K.
std::string modulus_row(double elastic, double plastic, const ModulusAnswer& answer, double shear_ratio);

/// A header and a line for each state. Where there are measurements also how far p and K are off, each over what was
/// measured, and the root of the mean of its square up to this line.
std::string modulus_table(const components::Modulus& modulus, components::ElasticUpdate form, double shear_ratio,
                          const ModulusStates& states);

/// Cost of an evaluation.
struct ModulusCosts {
  std::size_t n_evaluations;
  double ns_per_evaluation;
  std::size_t bytes;  ///< of the model
};

/// Evaluates a model on the states in the form given, in lanes, as the sand's update does: medians of `n_rounds`.
ModulusCosts modulus_costs(const components::Modulus& modulus, components::ElasticUpdate form,
                           const ModulusStates& states, int n_rounds);

}  // namespace tamp::tools
