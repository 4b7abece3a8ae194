/// Grids of lifting surfaces on beams and shells.
#pragma once

#include <culm/lattice/lattice_load.hpp>
#include <culm/model/build_context.hpp>

#include <optional>
#include <vector>

namespace culm::lattice {

/// An entry of the list "Surfaces".
Schema surface_schema();
/// The grid that it describes; nothing, after issues, if something is wrong.
std::optional<SurfaceGrid> read_surface(const Options& options, model::BuildContext& context);

/// A lattice along a beam: chord and camber at fractions of its length.
std::optional<SurfaceGrid> beam_surface(const Options& options, const model::Structure& beam,
                                        const std::vector<double>& stations,
                                        model::BuildContext& context);
/// A lattice between two edges of a shell, on its middle surface.
std::optional<SurfaceGrid> shell_surface(const Options& options, const model::Structure& shell,
                                         const std::vector<double>& stations,
                                         model::BuildContext& context);

/// Numbers of panels of a surface that is stated.
Panels panels_of(const Options& options);

}  // namespace culm::lattice
