/// Lists of a deck that describe the air about a turbine, and its motion in it.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/report.hpp>

#include "turbine_layout.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

// All of them: @pre turbine.air

/// Speeds of wind and rotor, stations, step and end.
void write_air_variables(const ElastoDyn& turbine, DeckWriter& deck);
/// The lists Flows, with the sea of a substructure, Airfoils and Functions.
/// @param folder  of the deck, from which it names files
void write_air(const ElastoDyn& turbine, const std::filesystem::path& folder, Report& report,
               DeckWriter& deck);
/// Entries of Loads: a `Strip` on each blade and on the tower, the `Rotor`.
void write_air_loads(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report,
                     DeckWriter& deck);
/// The entry of Constraints that turns the generator in operation.
void write_rotation(const TurbineLayout& layout, DeckWriter& deck);
/// The list Initial Conditions: the rotor turns.
void write_initial_velocities(const ElastoDyn& turbine, const TurbineLayout& layout,
                              DeckWriter& deck);
/// Names of what acts in operation only.
std::vector<std::string> names_of_air(const ElastoDyn& turbine);
/// The analysis of operation.
void write_operation(DeckWriter& deck);
/// Entries of Output / History.
void write_air_history(const ElastoDyn& turbine, DeckWriter& deck);

}  // namespace culm::openfast
