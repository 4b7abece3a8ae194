#include <culm/base/error.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/input_file.hpp>

#include "beamdyn_deck.hpp"
#include "turbine_deck.hpp"

#include <utility>

namespace culm::openfast {

namespace {

std::string import_turbine(const std::filesystem::path& path, const TurbineOptions& options,
                           Report& report) {
  ElastoDyn turbine = read_elastodyn(path, report);
  if (!options.blade.empty()) replace_blades(turbine, read_beamdyn(options.blade, report), report);
  if (options.blade_mass > 0.0) scale_blades(turbine, options.blade_mass, report);
  return write_deck(std::move(turbine), report);
}

}  // namespace

Imported import_file(const std::filesystem::path& path, const TurbineOptions& options) {
  const InputFile file(path);
  const bool is_turbine = file.has("NumBl");
  if (!is_turbine && (!options.blade.empty() || options.blade_mass > 0.0)) {
    throw UsageError(path.string() + ": is no turbine: --blade and --blade-mass need one");
  }
  Report report;
  std::string deck;
  if (is_turbine) {
    deck = import_turbine(path, options, report);
  } else if (file.has("InputFile")) {
    deck = write_deck(read_beamdyn_driver(path, report), report);
  } else if (file.has("kp_total")) {
    deck = write_deck(read_beamdyn(path, report), report);
  } else if (file.has("station_total")) {
    throw InputError(
        file.where("station_total"),
        "this is a blade file of BeamDyn, which has no geometry: give the primary file "
        "that names it");
  } else if (file.has("NBlInpSt") || file.has("NTwInpSt")) {
    throw InputError(file.where(0, ""),
                     "this is a blade or tower file of ElastoDyn: give the main file "
                     "that names it");
  } else {
    throw InputError(
        file.where(0, ""),
        "not a file that can be imported: a driver or primary file of BeamDyn, a main file "
        "of ElastoDyn");
  }
  return {std::move(deck), report.text("Import of " + path.string())};
}

}  // namespace culm::openfast
