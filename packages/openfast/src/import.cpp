#include <culm/base/error.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/glue_file.hpp>
#include <culm/openfast/import.hpp>
#include <culm/openfast/input_file.hpp>

#include "beamdyn_deck.hpp"
#include "headings.hpp"
#include "offshore.hpp"
#include "turbine_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

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

// BeamDyn's primary file of each blade; none where the blades are ElastoDyn's.
std::vector<std::filesystem::path> blade_files(const std::optional<GlueFile>& glue,
                                               const TurbineOptions& options, std::size_t blades) {
  if (!options.blade.empty()) return std::vector(blades, options.blade);
  if (!glue || glue->beamdyn.empty()) return {};
  if (glue->beamdyn.size() < blades) {
    throw InputError(
        {glue->path.string(), 0, fmt::format("BDBldFile({})", glue->beamdyn.size() + 1)},
        fmt::format("is missing: the turbine has {} blades", blades));
  }
  return {glue->beamdyn.begin(), glue->beamdyn.begin() + static_cast<std::ptrdiff_t>(blades)};
}

// Each file is read once.
std::vector<BeamDyn> read_blades(const std::vector<std::filesystem::path>& files, Report& report) {
  std::map<std::filesystem::path, BeamDyn> known;
  std::vector<BeamDyn> blades;
  for (const auto& file : files) {
    if (!known.contains(file)) known[file] = read_beamdyn(file, report);
    blades.push_back(known[file]);
  }
  return blades;
}

// A file that is named and not there is told to the report.
bool is_there(const GlueFile& glue, const std::filesystem::path& file, const char* module,
              const char* effect, Report& report) {
  if (std::filesystem::is_regular_file(file)) return true;
  report.add(missing, fmt::format("{}: names {}'s file {}, which is not there: {}",
                                  glue.path.string(), module, file.string(), effect));
  return false;
}

// Loads of the air and the wind, where both are switched on; still air without the wind.
std::optional<Air> find_air(const GlueFile& glue, const ElastoDyn& turbine, Report& report) {
  if (!glue.aerodyn || !is_there(glue, *glue.aerodyn, "AeroDyn", "no loads of the air", report)) {
    return std::nullopt;
  }
  constexpr double minute = 60.0;
  Air air{read_aerodyn(*glue.aerodyn, turbine.blades.size(), glue.air_density, report),
          {},
          glue.end.value_or(minute)};
  air.wind.height = turbine.hub_height();
  if (!glue.inflow) {
    report.add(assumed, glue.path.string() +
                            ": without InflowWind the air stands still; the "
                            "variable V is the speed at the hub");
  } else if (is_there(glue, *glue.inflow, "InflowWind", "the air stands still", report)) {
    air.wind = read_inflow(*glue.inflow, turbine.hub_height(), report);
  }
  return air;
}

// Members and water of a substructure, where it is switched on. What is imported of it is taken
// from the list of what is not.
std::optional<Substructure> find_substructure(const GlueFile& glue, Platform& platform,
                                              Report& report) {
  if (!glue.subdyn || !is_there(glue, *glue.subdyn, "SubDyn",
                                "what is below the tower is not in the deck", report)) {
    return std::nullopt;
  }
  const auto imported = [&](const char* module) {
    std::erase_if(platform.modules,
                  [&](const std::string& name) { return name.starts_with(module); });
  };
  Substructure found{read_subdyn(*glue.subdyn, report), {}};
  imported("SubDyn");
  if (glue.hydrodyn && is_there(glue, *glue.hydrodyn, "HydroDyn", "no water", report)) {
    found.water = read_hydrodyn(*glue.hydrodyn, read_surroundings(glue.path), report);
    imported("HydroDyn");
  }
  return found;
}

// A platform that moves in the water, where nothing else carries the tower.
std::optional<Floater> find_floater(const GlueFile& glue, const ElastoDyn& turbine,
                                    Report& report) {
  const Platform& platform = turbine.platform;
  const bool moves =
      std::find(platform.free.begin(), platform.free.end(), true) != platform.free.end();
  if (!glue.hydrodyn || !moves || !(platform.mass > 0.0) || glue.subdyn ||
      !is_there(glue, *glue.hydrodyn, "HydroDyn", "no water, and the platform is held", report)) {
    return std::nullopt;
  }
  if (!platform.reference.isZero(0.0)) {
    throw InputError(
        {turbine.path.string(), 0, "PtfmRefzt"},
        fmt::format("must be 0 where the platform floats, got {:g}", platform.reference.z()));
  }
  const Surroundings surroundings = read_surroundings(glue.path);
  Floater floater{read_hydrodyn(*glue.hydrodyn, surroundings, report), {}};
  floater.water.sea.rise = floater.water.sea.period;
  if (!glue.moordyn ||
      !is_there(glue, *glue.moordyn, "moorings", "nothing moors the platform", report)) {
    return floater;
  }
  Surroundings deep = surroundings;
  if (!deep.depth) deep.depth = floater.water.sea.depth;
  floater.moorings = read_moordyn(*glue.moordyn, deep, report);
  if (!floater.moorings->left_out.empty()) {
    const InputIssue& first = floater.moorings->left_out.front();
    throw InputError(first.where, first.message + ", and the platform would be moored otherwise");
  }
  return floater;
}

// What is in the deck is taken from the list of what is not.
void settle_water(const GlueFile& glue, ElastoDyn& turbine, Report& report) {
  const auto tell = [&](const char* flag) {
    const auto found = glue.unless_imported.find(flag);
    if (found != glue.unless_imported.end()) report.add(missing, found->second);
  };
  const auto imported = [&](const char* module) {
    std::erase_if(turbine.platform.modules,
                  [&](const std::string& name) { return name.starts_with(module); });
  };
  if (turbine.floater) imported("HydroDyn");
  if (turbine.floater && turbine.floater->moorings) imported("mooring");
  if (!turbine.floater && !turbine.substructure) {
    tell("CompSeaSt");
    tell("CompHydro");
  }
  if (!turbine.floater || !turbine.floater->moorings) tell("CompMooring");
}

// `glue` is what was given, or what was found beside the main file.
Imported import_turbine(const std::filesystem::path& path, const std::optional<GlueFile>& glue,
                        const TurbineOptions& options, Report& report) {
  ElastoDyn turbine = read_elastodyn(path, report);
  turbine.yaw_drive = find_yaw_drive(glue, options, report);
  if (glue) turbine.platform.modules = glue->substructure;
  if (glue && glue->gravity) turbine.gravity = *glue->gravity;
  const auto blades = blade_files(glue, options, turbine.blades.size());
  if (!blades.empty()) replace_blades(turbine, read_blades(blades, report), report);
  if (options.blade_mass > 0.0) scale_blades(turbine, options.blade_mass, report);
  if (glue) turbine.air = find_air(*glue, turbine, report);
  if (glue) turbine.substructure = find_substructure(*glue, turbine.platform, report);
  if (glue) turbine.floater = find_floater(*glue, turbine, report);
  if (glue) settle_water(*glue, turbine, report);
  Imported imported{{}, {}, variants_of(turbine), only_modes_of(turbine)};
  imported.deck = write_deck(std::move(turbine), options.folder, report);
  return imported;
}

Imported import_all(const std::filesystem::path& path, const TurbineOptions& options,
                    Report& report) {
  const GlueFile glue = read_glue_file(path, report);
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
