#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/aerodyn.hpp>
#include <culm/openfast/input_file.hpp>

#include "degree.hpp"
#include "entries.hpp"
#include "headings.hpp"
#include "left_out.hpp"
#include "named_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace culm::openfast {

namespace {

bool is_default(InputFile& file, const std::string& keyword) {
  return to_lower(file.text(keyword)) == "default";
}

// A switch that may be absent or "default".
int switch_of(InputFile& file, const std::string& keyword, int otherwise) {
  return file.has(keyword) && !is_default(file, keyword) ? file.integer(keyword) : otherwise;
}

bool flag_of(InputFile& file, const std::string& keyword, bool otherwise) {
  return file.has(keyword) && !is_default(file, keyword) ? file.flag(keyword) : otherwise;
}

InputError unknown_switch(const InputFile& file, const std::string& keyword, int value, int least,
                          int most) {
  return InputError(file.where(keyword),
                    fmt::format("must be from {} to {}, got {}", least, most, value));
}

std::string place(const InputFile& file, const std::string& keyword) {
  return to_string(file.where(keyword));
}

void read_induction(InputFile& file, AeroDyn& aero, Report& report) {
  const std::string keyword = name_of(file, "Wake_Mod", "WakeMod");
  const int wake = file.integer(keyword);
  if (wake < 0 || wake > 3) throw unknown_switch(file, keyword, wake, 0, 3);
  aero.induction = wake == 0 ? "None" : wake == 1 ? "Steady" : "Dynamic";
  if (wake == 2) {
    report.add(
        assumed,
        fmt::format(
            "{} = 2: dynamic inflow of Oye, whose first time follows the induction{}",
            place(file, keyword),
            switch_of(file, "DBEMT_Mod", 2) == 2
                ? ""
                : fmt::format("; DBEMT_Mod = {} wants it constant", file.integer("DBEMT_Mod"))));
  }
  if (wake == 3) {
    report.add(
        missing,
        fmt::format("{} = 3: the vortex wake of OLAF; the nearest is taken, blade element and "
                    "momentum with dynamic inflow",
                    place(file, keyword)));
  }
  aero.tip_loss = file.flag("TipLoss");
  aero.hub_loss = file.flag("HubLoss");
  const bool axial = file.flag("AIDrag"), tangential = file.flag("TIDrag");
  aero.drag_induces = axial;
  if (axial != tangential) {
    report.add(assumed, fmt::format("{}: drag counts in both balances of momentum or in none: as "
                                    "AIDrag says",
                                    place(file, "AIDrag")));
  }
  if (!file.flag("TanInd")) {
    report.add(missing, fmt::format("{} False: induction along the motion is there all the same",
                                    place(file, "TanInd")));
  }
}

void read_yaw(InputFile& file, AeroDyn& aero, Report& report) {
  if (file.has("SkewMod")) {
    const int skew = file.integer("SkewMod");
    aero.yaw = skew == 2 ? "Pitt Peters" : "None";
    if (skew == 3) {
      report.add(missing, place(file, "SkewMod") +
                              " = 3: the coupled model of skewed wakes; none is "
                              "taken");
    }
    return;
  }
  const int skew = switch_of(file, "Skew_Mod", 1);
  const int redistribution = switch_of(file, "SkewRedistr_Mod", 1);
  aero.yaw = skew == 1 && redistribution == 1 ? "Pitt Peters" : "None";
  if (flag_of(file, "SkewMomCorr", false)) {
    report.add(missing, place(file, "SkewMomCorr") +
                            " True: the balance of momentum in a wind at an "
                            "angle is that of a wind along the axis");
  }
}

void read_lag(InputFile& file, AeroDyn& aero, Report& report) {
  const std::string keyword = name_of(file, "UA_Mod", "UAMod");
  const bool steady = file.has("AFAeroMod") && file.integer("AFAeroMod") == 1;
  const int model = steady ? 0 : file.integer(keyword);
  if (model < 0 || model > 7) throw unknown_switch(file, keyword, model, 0, 7);
  aero.lag = model == 0 ? "None" : model == 6 || model == 7 ? "Oye" : "Four States";
  if (steady) file.ignore({"UA_Mod", "UAMod"});
  if (model != 0 && model != 4 && model != 6) {
    report.add(assumed, fmt::format("{} = {}: the nearest model of unsteady airfoils is taken, {}",
                                    place(file, keyword), model,
                                    model == 7 ? "Oye (6)" : "four states (4)"));
  }
  if (aero.lag == "Oye") {
    report.add(assumed, place(file, keyword) +
                            ": the flow that separates lags by 6 half chords; AeroDyn's by 3 where "
                            "an airfoil has no T_f0 of its own");
  }
  if (file.has("AoA34") && !flag_of(file, "AoA34", true)) {
    report.add(assumed, place(file, "AoA34") +
                            " False: the angle of attack is that of the "
                            "three-quarter chord all the same");
  }
}

// What is switched on and not in the deck.
void report_missing(InputFile& file, Report& report) {
  struct Effect {
    const char* keyword;
    const char* text;
  };
  constexpr Effect switches[] = {{"Buoyancy", "no buoyancy of blades, hub, nacelle and tower"},
                                 {"NacelleDrag", "no drag of the nacelle"},
                                 {"TFinAero", "no tail fin"},
                                 {"CompAA", "no noise"},
                                 {"CavitCheck", "no check of cavitation"},
                                 {"SectAvg", "no average of the wind over sectors"}};
  const auto is_on = [&](const char* keyword) {
    if (!file.has(keyword) || is_default(file, keyword)) return false;
    const std::string value = to_lower(file.text(keyword));
    return value != "0" && value != "false" && value != "f";
  };
  for (const Effect& effect : switches) {
    if (is_on(effect.keyword)) {
      report.add(missing, fmt::format("{} = {}: {}", place(file, effect.keyword),
                                      file.text(effect.keyword), effect.text));
    }
  }
  if (const int tables = switch_of(file, "AFTabMod", 1); tables != 1) {
    report.add(
        missing,
        fmt::format("{} = {}: coefficients do not depend on the Reynolds number or a setting: "
                    "the first table of each airfoil counts",
                    place(file, "AFTabMod"), tables));
  }
}

// Older files have a flag where newer ones have a number.
int switch_or_flag(InputFile& file, const char* keyword) {
  if (!file.has(keyword) || is_default(file, keyword)) return 0;
  const std::string value = to_lower(file.text(keyword));
  if (value == "true" || value == "t") return 1;
  if (value == "false" || value == "f") return 0;
  return file.integer(keyword);
}

std::vector<AeroTowerStation> read_drag_stations(InputFile& file) {
  if (file.integer("NumTwrNds") == 0) return {};
  if (file.integer("NumTwrNds") == 1) {
    throw InputError(file.where("NumTwrNds"), "a tower needs two heights at least, got 1");
  }
  const NamedTable table(file, "NumTwrNds", 3, "tower");
  std::vector<AeroTowerStation> tower;
  for (std::size_t i = 0; i < table.size(); ++i) {
    tower.push_back({table.at(i, "TwrElev"), table.positive(i, "TwrDiam"), table.at(i, "TwrCd"),
                     table.find(i, "TwrTI").value_or(0.1)});
    if (i > 0 && tower[i].height <= tower[i - 1].height) {
      throw InputError(file.where(table.line(i), "TwrElev"),
                       fmt::format("heights must rise, got {:g} after {:g} m", tower[i].height,
                                   tower[i - 1].height));
    }
  }
  return tower;
}

std::optional<AeroTowerInfluence> read_influence(InputFile& file,
                                                 const std::vector<AeroTowerStation>& shape) {
  const int upstream = switch_or_flag(file, "TwrPotent");
  const int downstream = switch_or_flag(file, "TwrShadow");
  if (upstream < 0 || upstream > 2) throw unknown_switch(file, "TwrPotent", upstream, 0, 2);
  if (downstream < 0 || downstream > 2) throw unknown_switch(file, "TwrShadow", downstream, 0, 2);
  if (upstream + downstream == 0) return {};
  if (shape.empty()) {
    throw InputError(file.where("NumTwrNds"),
                     "the influence of the tower is on, so its shape must be there");
  }
  constexpr std::array upstreams = {"None", "Potential", "Bak"};
  constexpr std::array downstreams = {"None", "Powles", "Eames"};
  return AeroTowerInfluence{upstreams[static_cast<std::size_t>(upstream)],
                            downstreams[static_cast<std::size_t>(downstream)], shape};
}

AeroBlade read_aero_blade(const std::filesystem::path& path, std::size_t airfoils, Report& report) {
  InputFile file(path);
  const NamedTable table(file, "NumBlNds", 7, "blade");
  AeroBlade blade{path, {}};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double airfoil = table.at(i, "BlAFID");
    if (!(airfoil >= 1.0 && airfoil <= static_cast<double>(airfoils)) ||
        airfoil != static_cast<double>(static_cast<std::size_t>(airfoil))) {
      throw InputError(
          file.where(table.line(i), "BlAFID"),
          fmt::format("must be a whole number from 1 to {}, got {:g}", airfoils, airfoil));
    }
    const double span = table.at(i, "BlSpn");
    const bool rises = i == 0 ? span == 0.0 : span > blade.stations.back().span;
    if (!rises) {
      throw InputError(file.where(table.line(i), "BlSpn"),
                       fmt::format("must rise from 0, got {:g}", span));
    }
    blade.stations.push_back({span, table.at(i, "BlCrvAC"), table.at(i, "BlSwpAC"),
                              degree * table.at(i, "BlTwist"), table.positive(i, "BlChord"),
                              static_cast<std::size_t>(airfoil) - 1});
  }
  report.add(read, fmt::format("{}: AeroDyn blade, {} stations; '{}'", path.string(), table.size(),
                               file.title()));
  double area = 0.0, moment = 0.0;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const AeroStation &low = blade.stations[i], &high = blade.stations[i + 1];
    const double length = high.span - low.span;
    area += 0.5 * length * (low.chord + high.chord);
    // of a chord that is linear in between
    moment +=
        length / 6.0 *
        (low.chord * (2.0 * low.span + high.span) + high.chord * (low.span + 2.0 * high.span));
  }
  report.add(checked,
             fmt::format("air: blade of {:.6g} m, area {:.6g} m^2, its centre {:.6g} m from "
                         "the root",
                         blade.stations.back().span, area, moment / area));
  report.add(unknown, file.unread());
  return blade;
}

// Names that stand once.
void distinguish(std::vector<AirfoilFile>& airfoils) {
  std::set<std::string> names;
  for (AirfoilFile& airfoil : airfoils) {
    const std::string stem = airfoil.name;
    for (int i = 2; !names.insert(airfoil.name).second; ++i) {
      airfoil.name = fmt::format("{} {}", stem, i);
    }
  }
}

AirfoilColumns read_columns(InputFile& file) {
  AirfoilColumns columns{file.integer("InCol_Alfa"), file.integer("InCol_Cl"),
                         file.integer("InCol_Cd"), file.integer("InCol_Cm")};
  for (const char* keyword : {"InCol_Alfa", "InCol_Cl", "InCol_Cd", "InCol_Cm"}) {
    const int least = std::string(keyword) == "InCol_Cm" ? 0 : 1;
    const int column = file.integer(keyword);
    if (column < least || column > 100) throw unknown_switch(file, keyword, column, least, 100);
  }
  return columns;
}

// What has no place in the deck, where it is not what it is without.
void report_not_used(InputFile& file, Report& report) {
  constexpr double skew = 15.0 * std::numbers::pi / 32.0;
  tell_left_out(file,
                {{"UAStartRad", 0.0, "unsteady aerodynamics from the root on"},
                 {"UAEndRad", 1.0, "unsteady aerodynamics up to the tip"},
                 {"SkewRedistrFactor", skew, "skewed wakes with 15 pi / 32"},
                 {"SkewModFactor", skew, "skewed wakes with 15 pi / 32"}},
                report);
}

void ignore_rest_of_aerodyn(InputFile& file) {
  file.ignore({"Echo",
               "DTAero",
               "FrozenWake",
               "AA_InputFile",
               "KinVisc",
               "SpdSound",
               "Patm",
               "Pvap",
               "FluidDepth",
               "BEM_Mod",
               "Skew_Mod",
               "SkewRedistr_Mod",
               "SkewRedistrFactor",
               "SkewModFactor",
               "SkewMomCorr",
               "IndToler",
               "MaxIter",
               "SectAvgWeighting",
               "SectAvgNPoints",
               "SectAvgPsiBwd",
               "SectAvgPsiFwd",
               "DBEMT_Mod",
               "tau1_const",
               "OLAFInputFileName",
               "FLookup",
               "IntegrationMethod",
               "UAStartRad",
               "UAEndRad",
               "InCol_Cpmin",
               "VolHub",
               "HubCenBx",
               "VolNac",
               "NacCenB",
               "NacArea",
               "NacCd",
               "NacDragAC",
               "TFinFile",
               "NumTwrNds",
               "SumPrint",
               "NBlOuts",
               "BlOutNd",
               "NTwOuts",
               "TwOutNd",
               "BldNd_BladesOut",
               "BldNd_BlOutNd",
               "TwrTipLoss",
               "Buoyancy",
               "CompAA",
               "CavitCheck",
               "NacelleDrag",
               "TFinAero",
               "AoA34",
               "SectAvg"});
  for (int i = 1; i <= 3; ++i) file.ignore({fmt::format("ADBlFile({})", i)});
}

}  // namespace

AeroDyn read_aerodyn(const std::filesystem::path& path, std::size_t blades,
                     std::optional<double> density, Report& report) {
  InputFile file(path);
  AeroDyn aero;
  aero.path = path;
  report.add(read, fmt::format("{}: AeroDyn; '{}'", path.string(), file.title()));
  if (!is_default(file, "AirDens")) {
    aero.density = file.number("AirDens");
  } else if (density) {
    aero.density = *density;
  } else {
    throw InputError(file.where("AirDens"), "is \"default\", but the .fst file has no AirDens");
  }
  if (!(aero.density > 0.0)) {
    throw InputError(file.where("AirDens"),
                     fmt::format("must be positive, got {:g}", aero.density));
  }
  read_induction(file, aero, report);
  read_yaw(file, aero, report);
  read_lag(file, aero, report);
  report_missing(file, report);
  const AirfoilColumns columns = read_columns(file);
  aero.has_moments = file.flag("UseBlCm") && columns.moment > 0;
  const int count = file.integer("NumAFfiles");
  if (count < 1 || count > 10000) throw unknown_switch(file, "NumAFfiles", count, 1, 10000);
  for (const auto& airfoil : file.files("AFNames", count)) {
    aero.airfoils.push_back(read_airfoil(airfoil, columns, report));
  }
  distinguish(aero.airfoils);
  std::map<std::filesystem::path, AeroBlade> known;
  for (std::size_t i = 1; i <= blades; ++i) {
    const auto blade = file.file(fmt::format("ADBlFile({})", i));
    if (!known.contains(blade)) known[blade] = read_aero_blade(blade, aero.airfoils.size(), report);
    aero.blades.push_back(known[blade]);
  }
  const std::vector<AeroTowerStation> tower = read_drag_stations(file);
  if (file.flag("TwrAero")) aero.tower = tower;
  aero.tower_influence = read_influence(file, tower);
  report_not_used(file, report);
  ignore_rest_of_aerodyn(file);
  report.add(unknown, file.unread());
  return aero;
}

}  // namespace culm::openfast
