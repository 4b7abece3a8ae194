/// What the air did in an analysis, in words.
#pragma once

#include <culm/model/model.hpp>

#include <string>

namespace culm::simulation {

/// A line for each rotor and lattice, and one for all strips of a kind, with the effects that
/// count: "air: Rotor 'rotor', 3 blades: wakes that follow, ...". Empty without such loads. Of a
/// lattice in motion how much of its wake is there.
std::string describe_air(const model::Model& model);

}  // namespace culm::simulation
