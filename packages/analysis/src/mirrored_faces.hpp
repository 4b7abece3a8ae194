/// Shell elements turned inside out.
#pragma once

#include <culm/model/model.hpp>

namespace culm::analysis {

/// Whether a face of a shell is its own mirror image: it turned around one of its lines while its
/// directors stayed. Strains, quadratic in the coordinates, do not see that.
/// @param q  of all nodes
bool has_mirrored_face(const model::Model& model, const model::Coordinates& q);

}  // namespace culm::analysis
