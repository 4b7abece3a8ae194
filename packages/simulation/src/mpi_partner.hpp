#pragma once

#include <culm/coupling/channel.hpp>
#include <culm/coupling/register_coupling.hpp>

#include <memory>
#include <string>

namespace culm::simulation {

/// Frames to and from a rank of all that were started together, one message each. Throws UsageError
/// where there are fewer.
std::unique_ptr<coupling::Channel> open_mpi_channel(int rank);
/// The same, or what coupling::listen opens. @param address  of the latter, or 'mpi:RANK'
std::unique_ptr<coupling::Channel> open_channel(const std::string& address, double patience);
/// Adds the partner of type 'MPI': a program in the same mpiexec.
void register_mpi_partner(coupling::PartnerRegistry& registry);

}  // namespace culm::simulation
