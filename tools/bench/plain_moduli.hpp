#pragma once

#include "components/moduli/elastic_model.hpp"
#include "components/moduli/network_fit.hpp"
#include "components/moduli/support_vector_fit.hpp"

/// The fitted models as their definitions have them, one state at a time and one number after the other (vectorization
/// by the compiler is off): what a batch is compared with, in time and in what it answers.
namespace tamp::tools::bench
{

/// Pressure as fitted and K.
components::ElasticPoint plain_support_vectors(const components::SupportVectorFit& fit, double elastic, double plastic);

/// K alone: the pressure is its integral, which no loop over neurons gives.
double plain_network(const components::NetworkFit& fit, double elastic, double plastic);

}  // namespace tamp::tools::bench
