/// Beams that are too taut for the length of their elements.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each structure with director elements of length L whose tension is above
/// c EI / L^2, c = 4, 24, 64.1 for orders 1 to 3. Between nodes that turn to and fro, so that the
/// points of quadrature feel nothing, directors are shorter than one: tension gains by that what
/// bending loses, and beyond the limit such turns grow by themselves.
/// @param q  complete on this rank
std::vector<std::string> taut_beams(const model::Model& model, const model::Coordinates& q);

}  // namespace culm::simulation
