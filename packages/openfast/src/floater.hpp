/// A turbine on a platform that floats: its lists in the deck.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/report.hpp>

#include <filesystem>

namespace culm::openfast {

/// The platform in the deck.
inline constexpr const char* platform_name = "platform";

// All of them: @pre turbine.floater

/// The body `ballast` of Structures, where something fills members, and what holds it.
void write_ballast(const ElastoDyn& turbine, DeckWriter& deck, Report& report);
void write_ballast_support(const ElastoDyn& turbine, DeckWriter& deck);
/// Entries of Constraints: the degrees of freedom that the file does not give the platform.
void write_held_freedoms(const ElastoDyn& turbine, DeckWriter& deck);
/// Entries of Loads: the water on the platform, what the file adds to it, mooring lines.
/// @param folder  of the deck, from which it names files
void write_floater_loads(const ElastoDyn& turbine, const std::filesystem::path& folder,
                         DeckWriter& deck, Report& report);
/// Entries of Output / History.
void write_floater_history(const ElastoDyn& turbine, DeckWriter& deck);

}  // namespace culm::openfast
