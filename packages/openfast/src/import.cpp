#include <culm/base/error.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/glue_file.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/input_file.hpp>

#include "beamdyn_deck.hpp"
#include "headings.hpp"
#include "offshore.hpp"
#include "turbine_deck.hpp"

#include <utility>

namespace culm::openfast {

namespace {

std::optional<YawDrive> find_yaw_drive(const std::optional<GlueFile>& glue,
                                       const TurbineOptions& options, Report& report) {
  if (!options.servodyn.empty()) return read_yaw_drive(options.servodyn, report);
  if (!glue || !glue->servodyn) return std::nullopt;
  if (std::filesystem::exists(*glue->servodyn)) return read_yaw_drive(*glue->servodyn, report);
  report.add(missing, glue->path.string() + ": names ServoDyn's file " + glue->servodyn->string() +
                          ", which is not there");
  return std::nullopt;
}

// `glue` is what was given, or what was found beside the main file.
Imported import_turbine(const std::filesystem::path& path, const std::optional<GlueFile>& glue,
                        const TurbineOptions& options, Report& report) {
  if (glue) report.add(read, glue->path.string() + ": names of the modules' files");
  ElastoDyn turbine = read_elastodyn(path, report);
  turbine.yaw_drive = find_yaw_drive(glue, options, report);
  if (glue) turbine.platform.modules = glue->substructure;
  if (glue && glue->gravity) turbine.gravity = *glue->gravity;
  if (!options.blade.empty()) replace_blades(turbine, read_beamdyn(options.blade, report), report);
  if (options.blade_mass > 0.0) scale_blades(turbine, options.blade_mass, report);
  Imported imported{{}, {}, variants_of(turbine)};
  imported.deck = write_deck(std::move(turbine), report);
  return imported;
}

Imported import_all(const std::filesystem::path& path, TurbineOptions options, Report& report) {
  const GlueFile glue = read_glue_file(path);
  if (glue.beamdyn && options.blade.empty()) options.blade = *glue.beamdyn;
  return import_turbine(glue.elastodyn, glue, options, report);
}

}  // namespace

Imported import_file(const std::filesystem::path& path, const TurbineOptions& options) {
  const InputFile file(path);
  const bool is_turbine = file.has("NumBl") || file.has("EDFile");
  if (!is_turbine &&
      (!options.blade.empty() || options.blade_mass > 0.0 || !options.servodyn.empty())) {
    throw UsageError(path.string() +
                     ": is no turbine: --blade, --blade-mass and --servodyn need one");
  }
  Report report;
  Imported imported;
  if (file.has("EDFile")) {
    imported = import_all(path, options, report);
  } else if (is_turbine) {
    imported = import_turbine(path, find_glue_file(path, report), options, report);
  } else if (file.has("InputFile")) {
    imported.deck = write_deck(read_beamdyn_driver(path, report), report);
  } else if (file.has("kp_total")) {
    imported.deck = write_deck(read_beamdyn(path, report), report);
  } else if (file.has("station_total")) {
    throw InputError(
        file.where("station_total"),
        "this is a blade file of BeamDyn, which has no geometry: give the primary file "
        "that names it");
  } else if (file.has("NBlInpSt") || file.has("NTwInpSt")) {
    throw InputError(file.where(0, ""),
                     "this is a blade or tower file of ElastoDyn: give the main file "
                     "that names it");
  } else if (auto deck = import_offshore(file, report)) {
    imported.deck = std::move(*deck);
  } else {
    throw InputError(
        file.where(0, ""),
        "not a file that can be imported: a driver or primary file of BeamDyn, a main file "
        "of ElastoDyn, the file that names both (.fst), or a file of SubDyn, HydroDyn, SeaState "
        "or MoorDyn");
  }
  imported.report = report.text("Import of " + path.string());
  return imported;
}

}  // namespace culm::openfast
