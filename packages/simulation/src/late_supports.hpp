/// Supports and connections that come in later than the deck begins.
#pragma once

#include <culm/base/options.hpp>
#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// Throws InputError for constraints that take unknowns away and do not hold at `q`, where the
/// analysis of this name begins: nothing would ever lead the structure back to them, and its nodes
/// would stay where they happen to be. Equations lead it back.
/// @param q            of all nodes
/// @param constraints  the list of the deck
void refuse_left_supports(const model::Model& model, const model::Coordinates& q,
                          const Options& constraints, const std::string& analysis);

/// What to say of equations that do not hold where a motion begins at a time.
std::vector<std::string> open_joints(const model::Model& model, const model::Coordinates& q,
                                     double time, const std::string& analysis);

}  // namespace culm::simulation
