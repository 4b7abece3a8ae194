/// Pressure and traction on a surface between the points of a port.
#pragma once

#include <culm/math/types.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace culm::port {

/// Three or four points of a port by their numbers, anticlockwise seen from outside; a triangle has
/// -1 as its fourth.
using Face = std::array<int, 4>;

/// Why faces do not belong to so many points: a number that there is not, or twice in a face; empty
/// if they do.
std::string objection_to(std::span<const Face> faces, int points);

/// Whether each edge belongs to two faces, in opposite directions.
bool is_closed(std::span<const Face> faces);

/// The volume inside of closed faces, x . n / 3 over them; quadrilaterals are bilinear.
/// @param positions  3 numbers per point [m]
double volume(std::span<const Face> faces, std::span<const double> positions);

/// Forces at the points of a pressure p, which pushes inwards, and a traction t on the faces,
/// f_a = int N_a (t |n| - p n) dA: mean of a straight motion from one shape to another, so that the
/// work of a pressure on a closed surface is -p times the change of its volume, exactly.
/// Quadrilaterals are bilinear. Integrals of n are exact; those of its size are where faces are
/// triangles or flat parallelograms.
/// @param from, to  positions at both ends of the motion, 3 numbers per point [m]
/// @param pressure  one number per face [Pa]; none: zero
/// @param traction  three numbers per face, in space [Pa]; none: zero
/// @return three numbers per point [N]
std::vector<double> face_forces(std::span<const Face> faces, std::span<const double> from,
                                std::span<const double> to, std::span<const double> pressure,
                                std::span<const double> traction);

}  // namespace culm::port
