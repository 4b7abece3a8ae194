/// A deck from SubDyn's file.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/report.hpp>
#include <culm/openfast/subdyn.hpp>

#include <string>

namespace culm::openfast {

// Entries of the lists of a deck, which are open.

void write_sections(const SubDyn& sub, DeckWriter& deck, Report& report);
/// Members as beams, concentrated masses with inertia as bodies. Throws InputError where nothing
/// gives a joint inertia.
void write_structures(const SubDyn& sub, DeckWriter& deck, Report& report);
/// Of the list Masses.
void write_masses(const SubDyn& sub, DeckWriter& deck, Report& report);
/// Joints, rigid links and supports; joints of the interface are rigid with each other.
void write_constraints(const SubDyn& sub, DeckWriter& deck, Report& report);
/// Of the list Loads.
void write_cables(const SubDyn& sub, DeckWriter& deck, Report& report);
/// Of the list Loads: stiffness of the ground at reaction joints.
void write_ground(const SubDyn& sub, DeckWriter& deck, Report& report);
/// Of the list Output / History: the interface and reactions.
void write_history(const SubDyn& sub, DeckWriter& deck, Report& report);

/// Tells the report masses by the tables.
void report_masses(const SubDyn& sub, Report& report);
/// The node that carries what stands on the substructure. Throws InputError if there is none.
std::string interface_node(const SubDyn& sub);

/// The members as beams, joined rigidly or by joints, under their weight, and their modes.
std::string write_deck(const SubDyn& sub, Report& report);

}  // namespace culm::openfast
