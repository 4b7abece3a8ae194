#pragma once

#include <culm/coupling/register_coupling.hpp>

namespace culm::simulation {

/// Adds the partner of type 'MPI': a program in the same mpiexec.
void register_mpi_partner(coupling::PartnerRegistry& registry);

}  // namespace culm::simulation
