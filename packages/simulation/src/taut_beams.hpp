/// Beams that are too taut for the length of their elements.
#pragma once

#include <culm/assembly/system.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each structure with director elements of length L whose tension is above
/// c EI / L^2, c = 4, 24, 64.1 for orders 1 to 3. Between nodes that turn to and fro, so that the
/// points of quadrature feel nothing, directors are shorter than one: tension gains by that what
/// bending loses, and beyond the limit such turns grow by themselves.
/// Collective. @param q  up to date for the nodes that the rank needs
std::vector<std::string> taut_beams(const assembly::System& system, const model::Coordinates& q);

}  // namespace culm::simulation
