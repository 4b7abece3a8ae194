#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/seastate.hpp>

#include "degree.hpp"
#include "entries.hpp"
#include "file_end.hpp"
#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>

namespace culm::openfast {

namespace {

bool is_default(InputFile& file, const char* keyword) {
  return to_lower(file.text(keyword)) == "default";
}

// A value that may be left to the file of the whole turbine.
double common(InputFile& file, const char* keyword, const std::optional<double>& there,
              std::optional<double> otherwise, Report& report) {
  if (file.has(keyword) && !is_default(file, keyword)) return file.number(keyword);
  if (there) return *there;
  if (!otherwise) {
    throw InputError(file.where(keyword),
                     "is left to the file that names this one, .fst or a driver, which is not "
                     "beside it: give a number");
  }
  report.add(assumed, to_string(file.where(keyword)) + fmt::format(": {:g}", *otherwise));
  return *otherwise;
}

std::optional<double> number_in(InputFile& file, const char* keyword) {
  if (!file.has(keyword)) return {};
  return file.number(keyword);
}

// A choice by its number, of which '1P45' is one as well.
std::string read_wave_mode(InputFile& file, SeaState& sea) {
  const std::string mode = to_lower(file.text("WaveMod"));
  if (mode == "0") return mode;
  if (mode == "1" || mode == "2") return mode;
  if (mode.starts_with("1p")) {
    try {
      sea.phase = degree * std::stod(mode.substr(2));
    } catch (const std::exception&) {
      throw InputError(file.where("WaveMod"), "'" + mode + "' must be 1P and a phase in degrees");
    }
    return "1";
  }
  throw InputError(
      file.where("WaveMod"),
      "'" + mode + "' is not imported (allowed: 0 still water, 1 or 1P# regular, 2 JONSWAP)");
}

std::string read_stretching(InputFile& file, Report& report) {
  if (!file.has("WaveStMod")) return "None";
  const int mode = file.integer("WaveStMod");
  if (mode == 0) return "None";
  if (mode == 1) return "Vertical";
  if (mode == 3) return "Wheeler";
  if (mode != 2) {
    throw InputError(file.where("WaveStMod"), fmt::format("must be 0, 1, 2 or 3, got {}", mode));
  }
  report.add(assumed, to_string(file.where("WaveStMod")) +
                          ": extrapolated profiles; in the deck as at still water, 'Vertical'");
  return "Vertical";
}

void read_waves(InputFile& file, SeaState& sea, Report& report) {
  const std::string mode = read_wave_mode(file, sea);
  sea.heading = degree * file.number("WaveDir", 0.0);  // of currents as well
  if (mode == "0") return;
  sea.kind = mode == "1" ? SeaState::Kind::regular : SeaState::Kind::irregular;
  sea.height = positive(file, "WaveHs");
  sea.period = positive(file, "WaveTp");
  sea.stretching = read_stretching(file, report);
  if (sea.kind == SeaState::Kind::regular) {
    if (sea.phase == 0.0) {
      report.add(assumed,
                 to_string(file.where("WaveMod")) +
                     ": the phase follows from a seed there; here a crest is at the origin "
                     "at time 0");
    }
    return;
  }
  if (!is_default(file, "WavePkShp")) {
    sea.peak = file.number("WavePkShp");
    if (*sea.peak < 1.0 || *sea.peak > 10.0) {
      throw InputError(file.where("WavePkShp"),
                       fmt::format("must be from 1 to 10, got {:g}", *sea.peak));
    }
  }
  const double turn = 2.0 * std::numbers::pi, peak = 1.0 / sea.period;
  const double lowest = file.number("WvLowCOff") / turn;
  const double highest = file.number("WvHiCOff") / turn;
  if (lowest > 0.0 && lowest < peak) sea.lowest = lowest;
  // beyond there is 1e-4 of the energy, and parts of the band would grow too wide for the rest
  const double clipped = std::min(highest, 10.0 * peak);
  if (highest > peak) sea.highest = clipped;
  if (clipped < highest) {
    report.add(assumed,
               fmt::format("{} = {:g} rad/s: waves up to ten times the frequency of the "
                           "peak, {:.4g} rad/s",
                           to_string(file.where("WvHiCOff")), turn * highest, turn * clipped));
  }
  if (lowest >= peak || (highest > 0.0 && highest <= peak)) {
    throw InputError(file.where(lowest >= peak ? "WvLowCOff" : "WvHiCOff"),
                     fmt::format("cuts off the peak of the waves, {:g} rad/s", turn * peak));
  }
  sea.seed = static_cast<int>(std::min(std::abs(file.number("WaveSeed(1)")), 2e9));
  report.add(assumed, to_string(file.where("WaveSeed(1)")) +
                          ": the same seed gives another sea with the same spectrum");
  if (file.number("WaveDirMod", 0.0) != 0.0) {
    sea.spreading = 2.0 * positive(file, "WaveDirSpread");
    sea.spreading_range = degree * positive(file, "WaveDirRange");
    report.add(assumed, to_string(file.where("WaveDirMod")) +
                            ": one direction per wave, not 'WaveNDir' of them in all");
  }
}

// The file's three currents are one in the deck: alone, or added up in a table if they go one way.
void read_current(InputFile& file, SeaState& sea, Report& report) {
  if (!file.has("CurrMod") && !file.has_heading("CURRENT")) return;
  if (file.number("CurrMod") == 0.0) return;
  if (file.number("CurrMod") != 1.0) {
    throw InputError(file.where("CurrMod"),
                     "user-defined currents are not imported; must be 0 or 1");
  }
  const double surface = file.number("CurrSSV0"), near = file.number("CurrNSV0"),
               uniform = file.number("CurrDIV");
  const double reference = file.number("CurrNSRef", 1.0);
  std::vector<double> headings;
  if (surface != 0.0) {
    headings.push_back(is_default(file, "CurrSSDir") ? sea.heading
                                                     : degree * file.number("CurrSSDir"));
  }
  if (near != 0.0) headings.push_back(degree * file.number("CurrNSDir"));
  if (uniform != 0.0) headings.push_back(degree * file.number("CurrDIDir"));
  if (headings.empty()) return;
  for (const double heading : headings) {
    if (std::abs(heading - headings.front()) <= 1e-9) continue;
    throw InputError(file.where("CurrMod"),
                     "currents in several directions are not imported; give all one heading");
  }
  sea.current_heading = headings.front();
  if (near == 0.0 && uniform == 0.0) {
    sea.current = "Power Law";
    sea.current_speed = surface;
  } else if (near == 0.0 && surface == 0.0) {
    sea.current = "Uniform";
    sea.current_speed = uniform;
  } else {
    sea.current = "Table";
    if (near != 0.0) positive(file, "CurrNSRef");
    constexpr int parts = 40;
    std::vector<double> depths;
    for (int i = 0; i <= parts; ++i) depths.push_back(sea.depth * i / parts);
    if (near != 0.0 && reference < sea.depth) depths.push_back(reference);
    std::sort(depths.begin(), depths.end());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    for (const double z : depths) {
      sea.current_depths.push_back(z);
      sea.current_speeds.push_back(uniform + surface * std::pow(1.0 - z / sea.depth, 1.0 / 7.0) +
                                   near * std::max(1.0 - z / reference, 0.0));
    }
    report.add(assumed, fmt::format("currents added up at {} depths", depths.size()));
  }
  if (sea.current != "Table" && sea.current_speed < 0.0) {
    sea.current_speed = -sea.current_speed;
    sea.current_heading += std::numbers::pi;
  }
}

void report_rest_of_seastate(InputFile& file, Report& report) {
  const auto warn = [&](const char* keyword, const std::string& what) {
    report.add(not_used, to_string(file.where(keyword)) + ": " + what);
  };
  for (const char* keyword : {"WvDiffQTF", "WvSumQTF"}) {
    if (file.has(keyword) && file.flag(keyword)) warn(keyword, "waves of second order");
  }
  if (file.number("ConstWaveMod", 0.0) != 0.0) warn("ConstWaveMod", "a constrained wave");
  if (file.number("MCFD", 0.0) > 0.0) warn("MCFD", "diffraction of MacCamy and Fuchs");
  if (file.has("WaveNDAmp") && file.flag("WaveNDAmp")) {
    warn("WaveNDAmp", "amplitudes by chance; here they follow from the spectrum");
  }
}

void finish(InputFile& file, Report& report) {
  ignore_sea(file);
  report.add(unknown, file.unread());
  check_end(file, report);
}

Surroundings surroundings_of(InputFile& file) {
  Surroundings found{file.path(),
                     number_in(file, "Gravity"),
                     number_in(file, "WtrDens"),
                     number_in(file, "WtrDpth"),
                     number_in(file, "MSL2SWL"),
                     {}};
  for (const char* name : {"SeaStFile", "SeaStateInputFile", "SeaStInputFile"}) {
    if (file.has(name)) found.seastate = file.file(name);
  }
  return found;
}

}  // namespace

Surroundings find_surroundings(const std::filesystem::path& module) {
  constexpr const char* names[] = {"HydroFile",      "SeaStFile",   "SubFile",
                                   "MooringFile",    "HDInputFile", "SeaStateInputFile",
                                   "SeaStInputFile", "SDInputFile", "InputFile"};
  const auto folder = module.has_parent_path() ? module.parent_path() : ".";
  std::vector<std::filesystem::path> candidates;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = to_lower(entry.path().extension().string());
    const bool names_others = ending == ".fst" || ending == ".dvr" || ending == ".inp";
    if (entry.is_regular_file() && names_others) candidates.push_back(entry.path());
  }
  std::sort(candidates.begin(), candidates.end());
  for (const auto& candidate : candidates) {
    std::error_code ignored;  // one that does not exist is not the same
    if (std::filesystem::equivalent(candidate, module, ignored)) continue;
    InputFile file(candidate);
    const bool is_it = std::any_of(std::begin(names), std::end(names), [&](const char* name) {
      return file.has(name) && std::filesystem::equivalent(file.file(name), module, ignored);
    });
    if (!is_it) continue;
    return surroundings_of(file);
  }
  return {};
}

Surroundings read_surroundings(const std::filesystem::path& whole) {
  InputFile file(whole);
  return surroundings_of(file);
}

void ignore_sea(InputFile& file) {
  file.ignore({"Echo",         "WaveTMax",     "WaveDT",      "WaveDirSpread", "WaveNDir",
               "WaveDirRange", "WaveSeed(2)",  "WvKinFile",   "WvLowCOffD",    "WvHiCOffD",
               "WvLowCOffS",   "WvHiCOffS",    "CrestHmax",   "CrestTime",     "CrestXi",
               "CrestYi",      "X_HalfWidth",  "Y_HalfWidth", "Z_Depth",       "NX",
               "NY",           "NZ",           "SeaStSum",    "OutSwtch",      "OutFmt",
               "OutSFmt",      "NWaveElev",    "WaveElevxi",  "WaveElevyi",    "NWaveKin",
               "WaveKinxi",    "WaveKinyi",    "WaveKinzi",   "WaveHs",        "WaveTp",
               "WavePkShp",    "WaveSeed(1)",  "WaveDir",     "WaveDirMod",    "WaveNDAmp",
               "WaveStMod",    "CurrMod",      "CurrSSV0",    "CurrSSDir",     "CurrNSRef",
               "CurrNSV0",     "CurrNSDir",    "CurrDIV",     "CurrDIDir",     "WvDiffQTF",
               "WvSumQTF",     "ConstWaveMod", "MCFD",        "WvLowCOff",     "WvHiCOff",
               "WtrDens",      "WtrDpth",      "MSL2SWL",     "WaveMod"});
}

SeaState read_seastate(const std::filesystem::path& path, const Surroundings& surroundings,
                       Report& report) {
  InputFile file(path);
  SeaState sea;
  sea.path = path;
  sea.title = file.title();
  if (!surroundings.path.empty()) {
    report.add(read, surroundings.path.string() + ": gravity, density and depth of the water");
  }
  if (surroundings.gravity) sea.gravity = *surroundings.gravity;
  sea.density = common(file, "WtrDens", surroundings.density, 1025.0, report);
  sea.level = common(file, "MSL2SWL", surroundings.level, 0.0, report);
  sea.depth = common(file, "WtrDpth", surroundings.depth, {}, report) + sea.level;
  if (!(sea.density > 0.0)) throw InputError(file.where("WtrDens"), "must be > 0");
  if (!(sea.depth > 0.0)) throw InputError(file.where("WtrDpth"), "must be > 0");
  read_waves(file, sea, report);
  read_current(file, sea, report);
  report_rest_of_seastate(file, report);
  const bool is_of_hydrodyn = file.has("NAxCoef");
  if (!is_of_hydrodyn) finish(file, report);
  report.add(read,
             path.string() + ": " +
                 (sea.kind == SeaState::Kind::still
                      ? "still water"
                      : fmt::format("{} waves of {:g} m and {:g} s",
                                    sea.kind == SeaState::Kind::regular ? "regular" : "irregular",
                                    sea.height, sea.period)) +
                 fmt::format(", {:g} m deep", sea.depth));
  return sea;
}

}  // namespace culm::openfast
