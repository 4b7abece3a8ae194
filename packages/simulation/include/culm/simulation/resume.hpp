/// From the folder of a run to where it goes on.
#pragma once

#include <culm/base/log.hpp>
#include <culm/base/options.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/read_deck.hpp>

#include <filesystem>
#include <string>

namespace culm::simulation {

/// A checkpoint of a run, the same on all ranks.
struct FoundCheckpoint {
  std::filesystem::path folder;  ///< with the results
  std::filesystem::path file;
  Snapshot snapshot;
};

/// The content of a checkpoint file. Throws FileError if it cannot be read, is damaged, or comes
/// from a version of culm that is not compatible.
std::string read_sound_checkpoint(const std::filesystem::path& file);

/// Reads a checkpoint to go on with.
/// @param path  the file, or the folder of the run or its run.h5: then the newest one that is
/// whole, with a
///              warning when it is not the newest one
/// Throws FileError on all ranks.
FoundCheckpoint find_checkpoint(const parallel::Comm& comm, const std::filesystem::path& path,
                                const Log& log);

/// Compares the deck to go on with to that of the checkpoint. Throws InputError with all
/// differences that would make another model, FileError if the deck in the checkpoint is not the
/// one that it was made with.
void check_resumed_deck(const Catalogue& catalogue, const Options& deck, const Snapshot& snapshot);

/// Where a run goes on, for the user.
std::string describe(const FoundCheckpoint& found, const Options& deck);

/// Warns where a run cannot go on bit by bit.
void warn_of_differences(const parallel::Comm& comm, const Snapshot& snapshot, const Log& log);

}  // namespace culm::simulation
