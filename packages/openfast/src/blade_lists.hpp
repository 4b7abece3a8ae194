/// Lists of a deck that describe a blade.
#pragma once

#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/report.hpp>

#include "blade_axis.hpp"

#include <string>

namespace culm::openfast {

/// Where the root of a blade is and how it stands.
struct Placement {
  Vec3 root = Vec3::Zero();      ///< [m]
  Mat3 axes = Mat3::Identity();  ///< columns: x, y, z of the blade root
};

/// How a blade is meshed.
struct BladeMesh {
  int elements = 24;
  int order = 2;
};

/// Entries of the list Sections: `name 1`, `name 2`, … for the stations.
void write_sections(const std::string& name, const BeamDynBlade& blade, DeckWriter& deck);
/// An entry of the list Structures with these sections.
void write_beam(const std::string& name, const std::string& sections, const BeamDyn& beam,
                const Placement& placement, const BladeMesh& mesh, DeckWriter& deck);

/// Sentences about axes, order of matrices and twist.
void report_conventions(Report& report);
/// Sentences about the mass of a blade and its damping.
void report_blade(const std::string& name, const BeamDyn& beam, Report& report);

}  // namespace culm::openfast
