/// The state of another run, from which an analysis may start.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/model/model.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/quantity.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// Says in a checkpoint which structures the model has: names, and checksums of the nodes of each
/// in the reference.
void save_structures(const model::Model& model, Snapshot& snapshot);

/// Says in a checkpoint whose memories "system/batches" holds, effects and how many numbers, and
/// whose unknowns "state/own", those of signals and drives.
void save_memory_owners(const model::Model& model, Snapshot& snapshot);
/// Moves what batches of another run remember to those of the same effect and size in a model: what
/// flowed, slid, or was counted; likewise the values of signals, by their names.
/// @param other     of find_state_of_run
/// @param snapshot  of the model, with "system/batches" and "state/own" as it begins
/// @return titles of what remembers something there and has no place here
std::vector<std::string> take_memories(const Snapshot& other, const model::Model& model,
                                       Snapshot& snapshot);

/// Says in a checkpoint whose memories "output/memories" holds.
void save_watched(const std::vector<WatchedQuantity>& watched, Snapshot& snapshot);
/// Moves what quantities of another run remember to those of the same name and size.
/// @param snapshot  with "output/memories" as they begin
/// @return those that rely on their memory and were not watched there
std::vector<std::string> take_watched(const Snapshot& other,
                                      const std::vector<WatchedQuantity>& watched,
                                      Snapshot& snapshot);

/// Reads the newest checkpoint of the run that 'Start From' of an analysis names. Unlike a run that
/// goes on, it takes no older one in its place, which would be another state.
/// Throws FileError on all ranks if the checkpoint is missing or damaged, or if the run.h5 beside
/// it is damaged or of another run; InputError if the structures are not those of the model.
Snapshot find_state_of_run(const parallel::Comm& comm, const Options& analysis,
                           const model::Model& model);

}  // namespace culm::simulation
