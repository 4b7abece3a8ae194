#include <culm/base/error.hpp>
#include <culm/openfast/glue_file.hpp>
#include <culm/openfast/input_file.hpp>

#include "degree.hpp"
#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace culm::openfast {

namespace {

// A module by its switch.
struct Module {
  const char* name;
  const char* flag;
  int most;            // largest value of the switch
  int imported;        // the value that is read, or 0
  const char* file;    // names its file, where it has one
  bool always;         // in files of all years: without it something would be lost
  const char* effect;  // what a value that is not read does
};
constexpr Module modules[] = {
    {"wind", "CompInflow", 2, 1, "InflowFile", true,
     "the wind of another program: the air stands still"},
    {"aerodynamics", "CompAero", 3, 2, "AeroFile", true,
     "AeroDisk, AeroDyn 14 or loads of another program: no loads of the air. AeroDyn is 2"},
    {"control", "CompServo", 1, 1, "ServoFile", true, ""},
    {"SeaState", "CompSeaSt", 1, 0, "SeaStFile", false, "no waves and no current"},
    {"HydroDyn", "CompHydro", 1, 0, "HydroFile", true,
     "no water: its inertia, which lowers frequencies, buoyancy, waves and drag are missing"},
    {"substructure", "CompSub", 2, 1, "SubFile", true,
     "what is below the tower does not bend: frequencies are too high"},
    {"moorings", "CompMooring", 4, 0, "MooringFile", true,
     "nothing moors the platform, which is held"},
    {"ice", "CompIce", 2, 0, "IceFile", true, "no loads of ice"},
    {"soil", "CompSoil", 1, 0, "SoilFile", false,
     "the base stands on rock: frequencies are too high"},
    {"water turbine", "MHK", 2, 0, nullptr, false, "its medium is air"}};
// Those that carry the tower, with the names of old.
constexpr std::pair<const char*, const char*> carriers[] = {{"HydroDyn", "CompHydro"},
                                                            {"SubDyn", "CompSub"},
                                                            {"mooring", "CompMooring"},
                                                            {"ice", "CompIce"}};

int value_of(InputFile& file, const Module& module) {
  if (!module.always && !file.has(module.flag)) return 0;
  const int value = file.integer(module.flag);
  if (value < 0 || value > module.most) {
    throw InputError(file.where(module.flag),
                     fmt::format("must be from 0 to {}, got {}", module.most, value));
  }
  return value;
}

const Module& module_of(const std::string& flag) {
  return *std::find_if(std::begin(modules), std::end(modules),
                       [&](const Module& module) { return module.flag == flag; });
}

// The file of a module whose switch has this value.
std::optional<std::filesystem::path> file_if(InputFile& file, const char* flag, int value) {
  const Module& module = module_of(flag);
  if (value_of(file, module) != value) return {};
  return file.file(module.file);
}

// Water and moorings need something to act on, which other files say.
bool depends(const Module& module, int value) {
  const std::string flag = module.flag;
  return ((flag == "CompHydro" || flag == "CompSeaSt") && value == 1) ||
         (flag == "CompMooring" && (value == 1 || value == 3));
}

void report_modules(InputFile& file, GlueFile& glue, Report& report) {
  for (const Module& module : modules) {
    const int value = value_of(file, module);
    if (value == 0 || value == module.imported) continue;
    const std::string named =
        module.file != nullptr && file.has(module.file) ? " (" + file.text(module.file) + ")" : "";
    const std::string sentence =
        fmt::format("{}: {}, {} = {}{}: {}", to_string(file.where(module.flag)), module.name,
                    module.flag, value, named, module.effect);
    if (depends(module, value)) {
      glue.unless_imported[module.flag] = sentence;
    } else {
      report.add(missing, sentence);
    }
  }
}

// Machines that ElastoDyn's main file does not describe as a whole.
void refuse_modules(InputFile& file) {
  if (const double kind = file.number("CompElast"); kind != 1.0 && kind != 2.0) {
    throw InputError(file.where("CompElast"),
                     fmt::format("must be 1, ElastoDyn, or 2, with blades of BeamDyn, got {:g}: "
                                 "simplified turbines cannot be imported",
                                 kind));
  }
  if (const double rotors = file.number("NRotors", 1.0); rotors != 1.0) {
    throw InputError(file.where("NRotors"), fmt::format("must be 1, got {:g}", rotors));
  }
  if (file.has("MirrorRotor") && file.flag("MirrorRotor")) {
    throw InputError(file.where("MirrorRotor"),
                     "rotors that turn the other way cannot be imported");
  }
}

void ignore_rest_of_glue(InputFile& file) {
  file.ignore({"Echo",        "AbortLevel", "DT",          "ModCoupling", "InterpOrder",
               "NumCrctn",    "RhoInf",     "ConvTol",     "MaxConvIter", "AutoRelax",
               "RelaxFactor", "DT_UJac",    "UJacSclFact", "CompLidar",   "LidarFile",
               "WtrDens",     "KinVisc",    "SpdSound",    "Patm",        "Pvap",
               "WtrDpth",     "MSL2SWL",    "SumPrint",    "SttsTime",    "ChkptTime",
               "DT_Out",      "TStart",     "OutFileFmt",  "TabDelim",    "OutFmt",
               "Linearize",   "CalcSteady", "TrimCase",    "TrimTol",     "TrimGain",
               "Twr_Kdmp",    "Bld_Kdmp",   "NLinTimes",   "LinTimes",    "LinInputs",
               "LinOutputs",  "LinOutJac",  "LinOutMod",   "WrVTK",       "VTK_type",
               "VTK_fields",  "VTK_fps",    "CompElast",   "NRotors",     "MirrorRotor"});
  for (const Module& module : modules) {
    if (module.file != nullptr) file.ignore({module.file});
  }
  for (int i = 1; i <= 3; ++i) file.ignore({fmt::format("BDBldFile({})", i)});
}

// One for each blade, of which the main file of ElastoDyn has the number.
std::vector<std::filesystem::path> named_blade_files(InputFile& file) {
  std::vector<std::filesystem::path> found{file.file("BDBldFile(1)")};
  for (int i = 2; file.has(fmt::format("BDBldFile({})", i)); ++i) {
    found.push_back(file.file(fmt::format("BDBldFile({})", i)));
  }
  return found;
}

bool are_same(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;  // one that does not exist is not the same
  return std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

GlueFile read_glue_file(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  refuse_modules(file);
  GlueFile glue;
  glue.path = path;
  glue.elastodyn = file.file("EDFile");
  if (file.number("CompElast") == 2.0) glue.beamdyn = named_blade_files(file);
  glue.servodyn = file_if(file, "CompServo", 1);
  glue.aerodyn = file_if(file, "CompAero", 2);
  glue.inflow = file_if(file, "CompInflow", 1);
  glue.seastate = file_if(file, "CompSeaSt", 1);
  glue.hydrodyn = file_if(file, "CompHydro", 1);
  glue.subdyn = file_if(file, "CompSub", 1);
  for (const int value : {1, 3}) {  // MAP++, MoorDyn
    if (const auto moorings = file_if(file, "CompMooring", value)) glue.moordyn = moorings;
  }
  if (file.has("Gravity")) glue.gravity = file.number("Gravity");
  if (file.has("AirDens")) glue.air_density = file.number("AirDens");
  if (file.has("TMax")) glue.end = file.number("TMax");
  for (const auto& [name, flag] : carriers) {
    const Module& module = module_of(flag);
    if (value_of(file, module) == 0) continue;
    glue.substructure.push_back(
        fmt::format("{} ({})", name, file.file(module.file).filename().string()));
  }
  report.add(read, path.string() + ": names of the modules' files");
  report_modules(file, glue, report);
  ignore_rest_of_glue(file);
  report.add(unknown, file.unread());
  return glue;
}

std::optional<GlueFile> find_glue_file(const std::filesystem::path& elastodyn, Report& report) {
  const auto folder = elastodyn.has_parent_path() ? elastodyn.parent_path() : ".";
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".fst") continue;
    InputFile file(entry.path());
    if (file.has("EDFile") && are_same(file.file("EDFile"), elastodyn))
      found.push_back(entry.path());
  }
  if (found.empty()) return std::nullopt;
  std::sort(found.begin(), found.end());
  if (found.size() > 1) {
    report.add(assumed, fmt::format("{} files beside {} name it: {} is taken; give another one "
                                    "itself to import it",
                                    found.size(), elastodyn.filename().string(),
                                    found.front().filename().string()));
  }
  return read_glue_file(found.front(), report);
}

YawDrive read_yaw_drive(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  YawDrive drive{path, file.number("YawSpr"), file.number("YawDamp"),
                 degree * file.number("YawNeut")};
  for (const char* name : {"YawSpr", "YawDamp"}) {
    if (!(file.number(name) >= 0.0)) {
      throw InputError(file.where(name), fmt::format("must be >= 0, got {:g}", file.number(name)));
    }
  }
  report.add(read,
             fmt::format("{}: ServoDyn, of it the yaw drive: spring {:g} N m/rad, damper {:g} "
                         "N m s/rad, neutral at {:g} degrees",
                         path.string(), drive.stiffness, drive.damping, drive.neutral / degree));
  struct Control {
    const char* flag;
    const char* effect;
  };
  constexpr Control controls[] = {
      {"PCMode", "pitch control: the blades stay at BlPitch"},
      {"VSContrl",
       "control of the torque: the generator turns at the speed that the deck prescribes"},
      {"HSSBrMode", "the brake of the shaft is not there"}};
  for (const Control& control : controls) {
    if (file.number(control.flag, 0.0) == 0.0) continue;
    report.add(missing, fmt::format("{} = {:g}, {}", to_string(file.where(control.flag)),
                                    file.number(control.flag), control.effect));
  }
  // newer files name theirs, older ones have one each in the nacelle and the tower
  for (const char* count : {"NumBStC", "NumNStC", "NumTStC", "NumSStC"}) {
    if (file.number(count, 0.0) == 0.0) continue;
    report.add(missing, fmt::format("{} = {:g}: structural controllers, dampers with masses of "
                                    "their own, are not there",
                                    to_string(file.where(count)), file.number(count)));
  }
  for (const char* flag : {"CompNTMD", "CompTTMD"}) {
    if (!file.has(flag) || !file.flag(flag)) continue;
    report.add(missing, to_string(file.where(flag)) + ": the tuned mass damper is not there");
  }
  if (file.number("YCMode", 0.0) != 0.0) {
    report.add(not_used, fmt::format("{}: yaw control, YCMode = {:g}: the neutral angle stays",
                                     to_string(file.where("YCMode")), file.number("YCMode")));
  }
  return drive;
}

}  // namespace culm::openfast
