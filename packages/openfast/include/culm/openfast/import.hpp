/// From files of OpenFAST to a deck.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// The deck with something changed, to tell by its modes what that does.
struct Variant {
  std::string name;
  std::vector<std::string> settings;  ///< path=value
};

/// What an import makes.
struct Imported {
  std::string deck;    ///< text of the deck
  std::string report;  ///< what was read, assumed, checked and left out
  std::vector<Variant> variants;
  /// Settings with which no more of the deck is run than its modes need.
  std::vector<std::string> only_modes;
};

/// What the files of a turbine leave open.
struct TurbineOptions {
  std::filesystem::path
      blade;  ///< primary file of BeamDyn in place of ElastoDyn's blades; may be empty
  double blade_mass = 0.0;         ///< to which the mass of each blade is scaled, if positive [kg]
  std::filesystem::path servodyn;  ///< file of ServoDyn with the yaw drive; may be empty
  std::filesystem::path folder{};  ///< of the deck, from which it names files of winds
};

/// Reads a file of OpenFAST and all that it names: a driver or primary file of BeamDyn, a main file
/// of ElastoDyn, the file that names those of all modules (.fst), or a file of SubDyn, HydroDyn,
/// SeaState or MoorDyn by itself. Beside a main file of ElastoDyn the latter is looked for, for
/// ServoDyn's file and the modules of the substructure.
/// Throws InputError with file, line and keyword, FileError, or UsageError for options without a
/// turbine.
Imported import_file(const std::filesystem::path& path, const TurbineOptions& options = {});

}  // namespace culm::openfast
