#include <culm/base/error.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/input_file.hpp>

#include "beamdyn_deck.hpp"

namespace culm::openfast {

Imported import_file(const std::filesystem::path& path) {
  const InputFile file(path);
  Report report;
  std::string deck;
  if (file.has("InputFile")) {
    deck = write_deck(read_beamdyn_driver(path, report), report);
  } else if (file.has("kp_total")) {
    deck = write_deck(read_beamdyn(path, report), report);
  } else if (file.has("station_total")) {
    throw InputError(
        file.where("station_total"),
        "this is a blade file of BeamDyn, which has no geometry: give the primary file "
        "that names it");
  } else {
    throw InputError(file.where(0, ""),
                     "not a file that can be imported: a driver or primary file of BeamDyn");
  }
  return {std::move(deck), report.text("Import of " + path.string())};
}

}  // namespace culm::openfast
