/// How far a structure turns on the way to a buckling load.
#pragma once

#include <culm/base/findings.hpp>
#include <culm/model/model.hpp>

namespace culm::analysis {

/// Warns where the linear response to the reference load times a factor turns a node by more than a
/// tenth of a radian: linear buckling leaves out that the structure has moved by then.
/// @param q       where the structure is; as `motion` up to date for all nodes
/// @param motion  linear response of the slots to the reference load
void warn_of_turns(const model::Model& model, const model::Coordinates& q,
                   const model::Coordinates& motion, double factor, double level,
                   Findings& findings);

}  // namespace culm::analysis
