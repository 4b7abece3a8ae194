/// Supports that take the same unknowns of a node away.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::model {

/// Notes for the user: which supports hold the same motions of which nodes. An unknown can be
/// eliminated once only, so nothing depends on it but the reaction of each support.
/// @param supports  constraints with a `fix` that was eliminated
std::vector<std::string> notes_on_repeated_supports(const Model& model,
                                                    const std::vector<const Constraint*>& supports);

}  // namespace culm::model
