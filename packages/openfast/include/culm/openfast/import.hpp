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

/// Reads a file of OpenFAST and all that it names: a driver or primary file of BeamDyn. Throws
/// InputError with file, line and keyword, or FileError.
Imported import_file(const std::filesystem::path& path);

}  // namespace culm::openfast
