/// Tower and blades of a turbine as cantilevers, and their damping.
#pragma once

#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/report.hpp>

#include "rayleigh.hpp"

namespace culm::openfast {

/// A blade clamped at its root. @param bending  place of the stiffness in the 6x6: 3 edge, 4 flap
Cantilever blade_cantilever(const BeamDyn& beam, int bending);
/// The tower clamped at its base, with the mass of what stands on it.
Cantilever tower_cantilever(const ElastoDyn& turbine, double TowerStation::*stiffness);

/// Mass of a blade [kg].
double blade_mass(const BeamDyn& beam);
/// Mass of what stands on the tower [kg].
double head_mass(const ElastoDyn& turbine);
/// Torsion stiffness of a station of the tower: that of the file, or that of a thin tube with these
/// bending stiffnesses, nu = 0.3 [N m^2].
double torsion_of(const TowerStation& station);
/// Moment at the top of the tower over its twist [N m/rad].
double torsion_stiffness(const ElastoDyn& turbine);

/// Gives blades that state no damping of their own the factors by which their first flap and edge
/// modes have the damping of the files; tells the report these and what higher modes get.
void find_blade_damping(ElastoDyn& turbine, Report& report);
/// The same for the tower: times by which stress runs ahead of strain, by strain [s].
std::vector<double> find_tower_damping(const ElastoDyn& turbine, Report& report);

}  // namespace culm::openfast
