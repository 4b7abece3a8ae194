/// How the layers of a wall share the strain across its thickness.
#pragma once

#include <culm/material/layup.hpp>

namespace culm::material {

/// A layup that answers to stretch and bending as one whose layers are each free of stress across
/// the thickness, though its elements stretch the thickness linearly from bottom to top, in all
/// layers alike. With E the strains 11, 22, 12, Q the stiffness free of normal stress, n that of
/// Poisson's ratios and c that across the thickness,
///   W = 1/2 E . Q E + 1/2 c (E33 + n . E)^2
/// of each layer; n becomes the mean over the wall, so that the wall gets as much thinner, and c
/// that of layers one upon the other, 1/c the mean of 1/c. Likewise the expansion across. A wall of
/// one material in one direction stays what it is.
/// @pre layup.is_linear(), and no coupling of normal and transverse shear strains
Layup with_common_thickness_strain(Layup layup);

}  // namespace culm::material
