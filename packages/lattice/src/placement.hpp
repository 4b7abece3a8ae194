/// Whether surfaces stand so that the flow about them is determined.
#pragma once

#include <culm/lattice/bound_lattice.hpp>

#include <optional>
#include <string>

namespace culm::lattice {

struct Misplaced {
  std::size_t surface = 0;
  std::string text;  ///< what is wrong with it
};

/// The first surface that crosses the plane of symmetry, stands behind it or lies in it, so that it
/// meets its own image or that of another one, or whose panels are those of another surface. The
/// circulations of such panels have no solution, or any.
/// @param grid   points in the reference
/// @param names  of the surfaces
std::optional<Misplaced> find_misplaced(const BoundLattice& lattice, const Points& grid,
                                        const std::vector<std::string>& names);

}  // namespace culm::lattice
