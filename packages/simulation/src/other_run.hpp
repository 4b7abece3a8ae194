/// The state of another run, from which an analysis may start.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/model/model.hpp>
#include <culm/parallel/comm.hpp>

#include <string>

namespace culm::simulation {

/// Says in a checkpoint which structures the model has: names, and checksums of the nodes of each
/// in the reference.
void save_structures(const model::Model& model, Snapshot& snapshot);

/// Reads the newest checkpoint of the run that 'Start From' of an analysis names. Unlike a run that
/// goes on, it takes no older one in its place, which would be another state.
/// Throws FileError on all ranks if the checkpoint is missing or damaged, or if the run.h5 beside
/// it is damaged or of another run; InputError if the structures are not those of the model.
Snapshot find_state_of_run(const parallel::Comm& comm, const Options& analysis,
                           const model::Model& model);

}  // namespace culm::simulation
