/// Decks of turbines.
#pragma once

#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/report.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// Scales the mass of each blade to `mass` [kg], the inertia of its sections with it.
void scale_blades(ElastoDyn& turbine, double mass, Report& report);

/// Takes these blades, one for each of the turbine.
void replace_blades(ElastoDyn& turbine, const std::vector<BeamDyn>& blades, Report& report);

/// Variants of the deck that show what tower torsion and yaw drive do to its modes.
std::vector<Variant> variants_of(const ElastoDyn& turbine);

/// Settings with which a run of the deck ends at its modes.
std::vector<std::string> only_modes_of(const ElastoDyn& turbine);

/// A turbine on a clamped tower, generator and pitch locked, under its weight; where there is air,
/// also in operation at constant speed.
/// @param folder  of the deck, from which it names files of winds
std::string write_deck(ElastoDyn turbine, const std::filesystem::path& folder, Report& report);

}  // namespace culm::openfast
