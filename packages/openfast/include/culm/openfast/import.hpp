/// From files of OpenFAST to a deck.
#pragma once

#include <filesystem>
#include <string>

namespace culm::openfast {

/// What an import makes.
struct Imported {
  std::string deck;    ///< text of the deck
  std::string report;  ///< what was read, assumed, checked and left out
};

/// What the files of a turbine leave open.
struct TurbineOptions {
  std::filesystem::path
      blade;  ///< primary file of BeamDyn in place of ElastoDyn's blades; may be empty
  double blade_mass = 0.0;  ///< to which the mass of each blade is scaled, if positive [kg]
};

/// Reads a file of OpenFAST and all that it names: a driver or primary file of BeamDyn, or a main
/// file of ElastoDyn. Throws InputError with file, line and keyword, FileError, or UsageError for
/// options without a turbine.
Imported import_file(const std::filesystem::path& path, const TurbineOptions& options = {});

}  // namespace culm::openfast
