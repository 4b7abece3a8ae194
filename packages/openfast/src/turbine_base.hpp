/// What a tower stands on, as far as the files say it.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/report.hpp>

#include <string>
#include <vector>

namespace culm::openfast {

/// Whether the tower stands on more than the ground: a base above the platform's reference point or
/// above zero, a platform with a mass or with degrees of freedom, modules of a substructure; where
/// the deck has the substructure, on modules beside it.
bool stands_on_more(const ElastoDyn& turbine);

/// Sentences about what carries the tower and is not in the deck, with the frequencies of the first
/// bending by which that can be judged; the same for the report and as a comment of the deck.
std::vector<std::string> describe_base(const ElastoDyn& turbine);

/// The body `platform` of the list Structures, if the file gives it a mass.
void write_platform(const ElastoDyn& turbine, DeckWriter& deck);

}  // namespace culm::openfast
