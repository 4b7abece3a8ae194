#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/elastodyn.hpp>
#include <culm/openfast/input_file.hpp>

#include "degree.hpp"
#include "headings.hpp"
#include "named_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

namespace culm::openfast {

namespace {

constexpr double percent = 0.01;

FileMode read_file_mode(InputFile& file, const std::string& name, const std::string& shape,
                        const std::string& damping) {
  FileMode mode{name, {}, percent * file.number(damping)};
  for (int k = 0; k < 5; ++k) {
    mode.coefficients[static_cast<std::size_t>(k)] =
        file.number(fmt::format("{}({})", shape, k + 2));
  }
  return mode;
}

// The first mode, and the second one where the file has its shape and damping.
FileModes read_modes(InputFile& file, const std::string& name, const std::string& first,
                     const std::string& second, const std::string& damping) {
  FileModes modes{read_file_mode(file, name, first, damping + "(1)"), {}};
  if (file.has(second + "(2)") && file.has(damping + "(2)")) {
    modes.second = read_file_mode(file, "second " + name, second, damping + "(2)");
  }
  return modes;
}

void report_tuners(InputFile& file, const std::vector<std::string>& tuners, Report& report) {
  for (const std::string& tuner : tuners) {
    if (file.number(tuner, 1.0) != 1.0) {
      report.add(unknown, to_string(file.where(tuner)) +
                              ": changes single modes of ElastoDyn, which "
                              "culm does not have: left out");
    }
  }
}

// ElastoDyn's blade neither stretches nor shears nor twists: stiff enough here to act alike, soft
// enough to be computed with. A factor of 1e4 over the length squared puts EA of usual blades at
// about five times its value.
struct Assumed {
  double stretch;
  double shear;
  double torsion;
};
Assumed assume_stiffness(double flap, double edge, double length) {
  constexpr double factor = 1e4;
  const double stretch = factor * (flap + edge) / (length * length);
  return {stretch, stretch / 2.6, flap + edge};
}

BladeStation make_station(const NamedTable& table, std::size_t i, double length, double mass_factor,
                          double flap_factor, double edge_factor) {
  const double m = mass_factor * table.positive(i, "BMassDen");
  const double flap = flap_factor * table.positive(i, "FlpStff");
  const double edge = edge_factor * table.positive(i, "EdgStff");
  const Assumed assumed = assume_stiffness(flap, edge, length);
  const double stretch = table.find(i, "EAStff").value_or(assumed.stretch);
  const double torsion = table.find(i, "GJStff").value_or(assumed.torsion);
  // sections of even density have the same radius in mass and stiffness
  const double edge_inertia = table.find(i, "EdgIner").value_or(m * edge / stretch);
  const double flap_inertia = table.find(i, "FlpIner").value_or(m * flap / stretch);
  BladeStation station{table.at(i, "BlFract"), Mat6::Zero(), Mat6::Zero(), 0};
  station.stiffness.diagonal() << stretch / 2.6, stretch / 2.6, stretch, edge, flap, torsion;
  station.mass.diagonal() << m, m, m, edge_inertia, flap_inertia, edge_inertia + flap_inertia;
  return station;
}

ElastoDynBlade read_bending_blade(const std::filesystem::path& path, double length,
                                  Report& report) {
  InputFile file(path);
  const NamedTable table(file, "DISTRIBUTED BLADE", "NBlInpSt");
  table.check_places("BlFract");
  ElastoDynBlade blade;
  blade.beam.path = path;
  blade.beam.title = file.title();
  blade.beam.blade.path = path;
  blade.beam.blade.title = file.title();
  const double mass_factor = file.number("AdjBlMs");
  const double flap_factor = file.number("AdjFlSt");
  const double edge_factor = file.number("AdjEdSt");
  for (std::size_t i = 0; i < table.size(); ++i) {
    blade.beam.blade.stations.push_back(
        make_station(table, i, length, mass_factor, flap_factor, edge_factor));
    blade.beam.key_points.push_back(
        {Vec3(0.0, 0.0, length * table.at(i, "BlFract")), degree * table.at(i, "StrcTwst")});
  }
  blade.flap = read_modes(file, "flap", "BldFl1Sh", "BldFl2Sh", "BldFlDmp");
  blade.edge = {read_file_mode(file, "edge", "BldEdgSh", "BldEdDmp(1)"), {}};
  report_tuners(file, {"FlStTunr(1)", "FlStTunr(2)"}, report);
  file.ignore({"FlStTunr(1)", "FlStTunr(2)", "BldFlDmp(2)", "CalcBMode"});
  report.add(read, fmt::format("{}: ElastoDyn blade, {} stations, masses times {:g}; '{}'",
                               path.string(), table.size(), mass_factor, file.title()));
  if (!table.has("EAStff") || !table.has("GJStff")) {
    report.add(assumed,
               "blades: ElastoDyn has no stretch, shear and torsion: EA = 1e4 (EI_flap + "
               "EI_edge) / length^2, GA = EA / 2.6, GJ = EI_flap + EI_edge; BeamDyn's blade "
               "can be given with --blade");
  }
  if (!table.has("FlpIner")) {
    report.add(assumed, "blades: rotary inertia m EI / EA, that of sections of even density");
  }
  report.add(unknown, file.unread());
  return blade;
}

ElastoDynTower read_bending_tower(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  const NamedTable table(file, "DISTRIBUTED TOWER", "NTwInpSt");
  table.check_places("HtFract");
  ElastoDynTower tower{path, file.title(), {}, {}, {}};
  const double mass_factor = file.number("AdjTwMa");
  const double fa_factor = file.number("AdjFASt");
  const double ss_factor = file.number("AdjSSSt");
  for (std::size_t i = 0; i < table.size(); ++i) {
    tower.stations.push_back({table.at(i, "HtFract"), mass_factor * table.positive(i, "TMassDen"),
                              fa_factor * table.positive(i, "TwFAStif"),
                              ss_factor * table.positive(i, "TwSSStif"), table.find(i, "TwGJStif"),
                              table.find(i, "TwEAStif"), table.find(i, "TwFAIner"),
                              table.find(i, "TwSSIner")});
  }
  tower.fore_aft = read_modes(file, "fore-aft", "TwFAM1Sh", "TwFAM2Sh", "TwrFADmp");
  tower.side_side = read_modes(file, "side-to-side", "TwSSM1Sh", "TwSSM2Sh", "TwrSSDmp");
  const std::vector<std::string> tuners{"FAStTunr(1)", "FAStTunr(2)", "SSStTunr(1)", "SSStTunr(2)"};
  report_tuners(file, tuners, report);
  file.ignore(tuners);
  file.ignore({"TwrFADmp(2)", "TwrSSDmp(2)", "CalcTMode"});
  report.add(read, fmt::format("{}: ElastoDyn tower, {} stations; '{}'", path.string(),
                               table.size(), file.title()));
  report.add(unknown, file.unread());
  return tower;
}

// What a rigid model of three blades cannot do, if the file asks for it.
void refuse_rotors(InputFile& file) {
  if (file.has("Furling") && file.flag("Furling")) {
    throw InputError(file.where("Furling"), "furling turbines cannot be imported");
  }
  for (const char* offset : {"UndSling", "Delta3"}) {
    if (file.number("NumBl") == 2 && file.number(offset, 0.0) != 0.0) {
      throw InputError(file.where(offset), "teetering rotors cannot be imported");
    }
  }
}

void ignore_rest_of_elastodyn(InputFile& file) {
  file.ignore(
      {"Echo",     "Method",         "DT",       "FlapDOF1",  "FlapDOF2",        "EdgeDOF",
       "PitchDOF", "TeetDOF",        "DrTrDOF",  "GenDOF",    "TwFADOF1",        "TwFADOF2",
       "TwSSDOF1", "TwSSDOF2",       "OoPDefl",  "IPDefl",    "TeetDefl",        "TTDspFA",
       "TTDspSS",  "PtfmSurge",      "PtfmSway", "PtfmHeave", "PtfmRoll",        "PtfmPitch",
       "PtfmYaw",  "UndSling",       "Delta3",   "ShftGagL",  "NcIMUxn",         "NcIMUyn",
       "NcIMUzn",  "HubIner_Teeter", "TeetMod",  "TeetDmpP",  "TeetDmp",         "TeetCDmp",
       "TeetSStP", "TeetHStP",       "TeetSSSp", "TeetHSSp",  "YawFrctMod",      "M_CSmax",
       "M_FCSmax", "M_MCSmax",       "M_CD",     "M_FCD",     "M_MCD",           "sig_v",
       "sig_v2",   "OmgCut",         "GBoxEff",  "Furling",   "FurlFile",        "TwrNodes",
       "SumPrint", "OutFile",        "TabDelim", "OutFmt",    "TStart",          "DecFact",
       "NTwGages", "TwrGagNd",       "NBlGages", "BldGagNd",  "BldNd_BladesOut", "BldNd_BlOutNd"});
  for (int i = 1; i <= 3; ++i) {
    file.ignore({fmt::format("PBrIner({})", i), fmt::format("BlPIner({})", i),
                 fmt::format("BldFile({})", i), fmt::format("PreCone({})", i),
                 fmt::format("BlPitch({})", i), fmt::format("TipMass({})", i)});
  }
}

// Whether a degree of freedom is there and switched on.
bool is_free(InputFile& file, const char* name) { return file.has(name) && file.flag(name); }

Platform read_platform(InputFile& file) {
  Platform platform;
  const char* freedoms[] = {"PtfmSgDOF", "PtfmSwDOF", "PtfmHvDOF",
                            "PtfmRDOF",  "PtfmPDOF",  "PtfmYDOF"};
  for (std::size_t i = 0; i < platform.free.size(); ++i) {
    platform.free[i] = is_free(file, freedoms[i]);
  }
  const char* axes[] = {"x", "y", "z"};
  const char* inertias[] = {"PtfmRIner", "PtfmPIner", "PtfmYIner"};
  for (int i = 0; i < 3; ++i) {
    platform.reference[i] = file.number(fmt::format("PtfmRef{}t", axes[i]), 0.0);
    platform.centre[i] = file.number(fmt::format("PtfmCM{}t", axes[i]), 0.0);
    platform.inertia[i] = file.number(inertias[i], 0.0);
  }
  platform.mass = file.number("PtfmMass", 0.0);
  for (int i = 0; i < 3 && platform.mass > 0.0; ++i) {
    if (platform.inertia[i] > 0.0) continue;
    throw InputError(file.where("PtfmMass"),
                     fmt::format("is {:g} kg, so that {} must be above 0, got {:g}: a point turns "
                                 "without resistance",
                                 platform.mass, inertias[i], platform.inertia[i]));
  }
  return platform;
}

void read_rotor(InputFile& file, ElastoDyn& turbine) {
  const int blades = file.integer("NumBl");
  if (blades < 1 || blades > 3) {
    throw InputError(file.where("NumBl"), fmt::format("must be 1, 2 or 3, got {}", blades));
  }
  turbine.tip_radius = file.number("TipRad");
  turbine.hub_radius = file.number("HubRad");
  if (!(turbine.tip_radius > turbine.hub_radius)) {
    throw InputError(file.where("TipRad"), fmt::format("must be above HubRad, {:g}, got {:g}",
                                                       turbine.hub_radius, turbine.tip_radius));
  }
  for (int i = 1; i <= blades; ++i) {
    turbine.cones.push_back(degree * file.number(fmt::format("PreCone({})", i)));
    turbine.pitches.push_back(degree * file.number(fmt::format("BlPitch({})", i)));
    turbine.tip_masses.push_back(file.number(fmt::format("TipMass({})", i), 0.0));
  }
  turbine.azimuth = degree * (file.number("Azimuth") - file.number("AzimB1Up", 0.0));
  turbine.rotor_speed = file.number("RotSpeed") * std::numbers::pi / 30.0;
  turbine.hub_centre = file.number("HubCM");
  turbine.hub_mass = file.number("HubMass");
  turbine.hub_inertia = file.number("HubIner");
  turbine.blade_nodes = file.integer("BldNodes");
}

void read_nacelle(InputFile& file, ElastoDyn& turbine) {
  turbine.tower_top = file.number("TowerHt");
  turbine.tower_base = file.number("TowerBsHt", 0.0);
  if (!(turbine.tower_top > turbine.tower_base)) {
    throw InputError(file.where("TowerHt"), fmt::format("must be above TowerBsHt, {:g}, got {:g}",
                                                        turbine.tower_base, turbine.tower_top));
  }
  turbine.yaw = degree * file.number("NacYaw", 0.0);
  turbine.yaw_is_free = is_free(file, "YawDOF");
  const char* axes[] = {"xn", "yn", "zn"};
  for (int i = 0; i < 3; ++i) {
    turbine.nacelle_centre[i] = file.number(std::string("NacCM") + axes[i]);
  }
  turbine.shaft_height = file.number("Twr2Shft");
  turbine.overhang = file.number("OverHang");
  turbine.tilt = degree * file.number("ShftTilt");
  turbine.nacelle_mass = file.number("NacMass");
  turbine.nacelle_inertia = file.number("NacYIner");
  turbine.yaw_bearing_mass = file.number("YawBrMass", 0.0);
  turbine.generator_inertia = file.number("GenIner");
  turbine.gear_ratio = file.number("GBRatio");
  turbine.shaft_stiffness = file.number("DTTorSpr");
  turbine.shaft_damping = file.number("DTTorDmp");
}

void report_left_out(InputFile& file, Report& report) {
  for (const char* entry : {"PtfmSurge", "PtfmSway", "PtfmHeave", "PtfmRoll", "PtfmPitch",
                            "PtfmYaw", "PtfmXYIner", "PtfmYZIner", "PtfmXZIner", "OoPDefl",
                            "IPDefl", "TTDspFA", "TTDspSS", "PBrIner(1)", "BlPIner(1)"}) {
    if (file.number(entry, 0.0) != 0.0) {
      report.add(not_used,
                 fmt::format("{} = {:g}", to_string(file.where(entry)), file.number(entry)));
    }
  }
  file.ignore({"PtfmXYIner", "PtfmYZIner", "PtfmXZIner"});
  std::vector<std::string> off;
  for (const char* name : {"FlapDOF1", "FlapDOF2", "EdgeDOF", "DrTrDOF", "TwFADOF1", "TwFADOF2",
                           "TwSSDOF1", "TwSSDOF2"}) {
    if (file.has(name) && !file.flag(name)) off.emplace_back(name);
  }
  if (!off.empty()) {
    report.add(not_used,
               fmt::format("{}: {} False: blades, tower and shaft bend and twist here all "
                           "the same",
                           file.path().string(), join(off, ", ")));
  }
  report.add(not_used, fmt::format("{}: teeter, yaw friction, outputs; pitch and generator are "
                                   "locked",
                                   file.path().string()));
}

}  // namespace

double ElastoDyn::hub_height() const {
  return tower_top + shaft_height + overhang * std::sin(tilt);
}

ElastoDyn read_elastodyn(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  report.add(read, fmt::format("{}: ElastoDyn; '{}'", path.string(), file.title()));
  refuse_rotors(file);
  ElastoDyn turbine;
  turbine.path = path;
  turbine.title = file.title();
  read_rotor(file, turbine);
  read_nacelle(file, turbine);
  const double length = turbine.tip_radius - turbine.hub_radius;
  std::map<std::filesystem::path, ElastoDynBlade> blades;
  for (std::size_t i = 1; i <= turbine.cones.size(); ++i) {
    const auto blade_path = file.file(fmt::format("BldFile({})", i));
    if (!blades.contains(blade_path))
      blades[blade_path] = read_bending_blade(blade_path, length, report);
    turbine.blades.push_back(blades[blade_path]);
  }
  turbine.tower = read_bending_tower(file.file("TwrFile"), report);
  turbine.platform = read_platform(file);
  if (file.has("Gravity")) turbine.gravity = file.number("Gravity");  // before OpenFAST 3
  report_left_out(file, report);
  ignore_rest_of_elastodyn(file);
  report.add(unknown, file.unread());
  return turbine;
}

}  // namespace culm::openfast
