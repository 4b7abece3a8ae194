/// What a model consists of, in words, for `culm check`.
#pragma once

#include <culm/model/model.hpp>

#include <string>

namespace culm::simulation {

/// Nodes, elements, mass, centre of mass and inertia of each structure and in total, at the start.
std::string report_masses(const model::Model& model);
/// Supports and joints, what they act on and what becomes of their equations.
std::string report_constraints(const model::Model& model);
/// Unknowns and degrees of freedom.
std::string report_unknowns(const model::Model& model);

}  // namespace culm::simulation
