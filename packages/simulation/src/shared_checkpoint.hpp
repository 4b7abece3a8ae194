#pragma once

#include <culm/base/snapshot.hpp>
#include <culm/parallel/comm.hpp>

#include <filesystem>

namespace culm::simulation {

/// Writes a checkpoint: what the snapshot says is whole on rank 0, which writes it, and of its
/// tables each rank writes its rows. Collective. Throws FileError on all ranks.
void write_shared_checkpoint(const parallel::Comm& comm, const std::filesystem::path& path,
                             const Snapshot& snapshot);

}  // namespace culm::simulation
