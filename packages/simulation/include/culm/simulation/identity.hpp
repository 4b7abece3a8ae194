/// What belongs together.
#pragma once

#include <culm/base/options.hpp>
#include <culm/model/model.hpp>
#include <culm/parallel/comm.hpp>

#include <string>

namespace culm::simulation {

/// A number that no other run has, the same on all ranks; 32 hexadecimal digits.
std::string new_run_identity(const parallel::Comm& comm);

/// A checksum of the deck with all variables and defaults resolved; 16 hexadecimal digits.
std::string identity_of(const Options& deck);

/// A checksum of the files that the deck reads, and of what both have become: nodes, equations,
/// batches with their memories, and functions of time at their corners. @pre the model is frozen
std::string identity_of(const model::Model& model, const Options& deck);

}  // namespace culm::simulation
