#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/text_table.hpp>

#include "file_end.hpp"
#include "headings.hpp"
#include "left_out.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace culm::openfast {

namespace {

double bounded(const TextTable& table, std::size_t row, const std::string& name) {
  const double value = table.number(row, {name.c_str()});
  if (value >= 0.0) return value;
  throw InputError(table.where(row, {name.c_str()}), fmt::format("must be >= 0, got {:g}", value));
}

// The same, or `otherwise` where there is no such column.
double bounded(const TextTable& table, std::size_t row, const std::string& name, double otherwise) {
  return table.has({name.c_str()}) ? bounded(table, row, name) : otherwise;
}

// Columns such as SimplCd and SimplCdMG, MemberCd1 and MemberCdMG1.
HydroPair read_pair(const TextTable& table, std::size_t row, const std::string& before,
                    const std::string& after) {
  HydroPair pair;
  for (std::size_t grown = 0; grown < 2; ++grown) {
    const std::string end = (grown == 1 ? "MG" : "") + after;
    const auto required = [&](const char* name) {
      const std::string column = before + name + end;
      if (table.has({column.c_str()})) return bounded(table, row, column);
      throw InputError(table.where(row, {column.c_str()}), "the table has no such column");
    };
    pair[grown] = {required("Cd"), required("Ca"), bounded(table, row, before + "Cp" + end, 1.0),
                   bounded(table, row, before + "Cb" + end, 1.0)};
  }
  return pair;
}

// Since OpenFAST 4 there are tables of their own for rectangular members, and names that say so.
const char* one_of(const InputFile& file, const char* cylindrical, const char* all) {
  return file.has(cylindrical) ? cylindrical : all;
}

// The line below the simple coefficients has no count. Of headings there are several spellings;
// that of rectangular members comes second.
HydroPair read_simple(const InputFile& file) {
  constexpr const char* since_2_3 = "COEFFICIENTS (model 1)";
  const char* heading =
      file.has_heading(since_2_3) ? since_2_3 : "SIMPLE HYDRODYNAMIC COEFFICIENTS";
  const TextTable table(file, "simple coefficients", file.rows_below(heading), 1);
  return read_pair(table, 0, "Simpl", "");
}

std::vector<HydroDepth> read_by_depth(InputFile& file) {
  std::vector<HydroDepth> depths;
  const char* keyword = one_of(file, "NCoefDpthCyl", "NCoefDpth");
  const TextTable table = read_table(file, keyword, "coefficients by depth");
  for (std::size_t i = 0; i < table.size(); ++i) {
    // heights over mean sea level, in spite of their name
    depths.push_back({-table.number(i, {"Dpth"}), read_pair(table, i, "Dpth", "")});
    if (i > 0 && !(depths[i].depth > depths[i - 1].depth)) {
      throw InputError(
          table.where(i, {"Dpth"}),
          fmt::format("must be below the one before, {:g}: 'Dpth' is a height over mean "
                      "sea level, such as -10",
                      -depths[i - 1].depth));
    }
  }
  return depths;
}

void read_growth(InputFile& file, HydroDyn& hydro) {
  const TextTable table = read_table(file, "NMGDepths", "marine growth");
  for (std::size_t i = 0; i < table.size(); ++i) {
    hydro.growth.push_back(
        {table.number(i, {"MGDpth"}), bounded(table, i, "MGThck"), bounded(table, i, "MGDens")});
  }
  std::sort(hydro.growth.begin(), hydro.growth.end(),
            [](const HydroGrowth& a, const HydroGrowth& b) { return a.height < b.height; });
}

struct HydroLists {
  std::map<int, std::size_t> joints, sections, own;
  std::vector<std::array<double, 2>> tubes;  // diameter and wall
  std::vector<std::array<HydroPair, 2>> coefficients;
};

void read_joints(InputFile& file, HydroDyn& hydro, HydroLists& lists, Report& report) {
  const TextTable axial = read_table(file, "NAxCoef", "axial coefficient");
  const std::map<int, std::size_t> axials = index_rows(axial, {"AxCoefID"});
  for (const char* name : {"AxCd", "AxCa"}) {
    if (axial.size() == 0 || axial.has({name})) continue;
    throw InputError(axial.where(0, {name}), "the table has no such column");
  }
  const TextTable table = read_table(file, "NJoints", "joint");
  lists.joints = index_rows(table, {"JointID"});
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::size_t row = look_up(axials, table, i, {"JointAxID"}, "axial coefficient");
    hydro.joints.push_back(
        {table.integer(i, {"JointID"}),
         {table.number(i, {"Jointxi"}), table.number(i, {"Jointyi"}), table.number(i, {"Jointzi"})},
         bounded(axial, row, "AxCd", 0.0),
         bounded(axial, row, "AxCa", 0.0)});
    for (const auto& [name, neutral] :
         {std::pair{"AxFDMod", 0.0}, {"AxVnCOff", 0.0}, {"AxFDLoFSc", 1.0}}) {
      const double value = axial.number(row, {name}, neutral);
      if (value == neutral || hydro.joints.back().drag == 0.0) continue;
      report.add(not_used, fmt::format("{} = {:g}: the drag of faces is that of {:g}",
                                       to_string(axial.where(row, {name})), value, neutral));
    }
    if (bounded(axial, row, "AxCp", 1.0) != 1.0) {
      report.add(not_used, to_string(axial.where(row, {"AxCp"})) +
                               ": pressure of waves on faces counts fully");
    }
    if (table.number(i, {"JointOvrlp"}, 0.0) != 0.0) {
      report.add(not_used, to_string(table.where(i, {"JointOvrlp"})) +
                               ": volumes that overlap at the joint are counted twice");
    }
  }
}

void read_sections(InputFile& file, HydroLists& lists) {
  const char* keyword = one_of(file, "NPropSetsCyl", "NPropSets");
  const TextTable table = read_table(file, keyword, "section");
  lists.sections = index_rows(table, {"PropSetID", "MPropSetID"});
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double diameter = bounded(table, i, "PropD", 0.0);
    const double wall = bounded(table, i, "PropThck", 0.0);
    if (!(diameter > 0.0) || wall > 0.5 * diameter) {
      throw InputError(table.where(i, {diameter > 0.0 ? "PropThck" : "PropD"}),
                       "the diameter must be > 0 and the wall at most half of it");
    }
    lists.tubes.push_back({diameter, wall});
  }
  if (file.has("NPropSetsRec") && file.integer("NPropSetsRec") != 0) {
    throw InputError(file.where("NPropSetsRec"), "rectangular members are not imported; must be 0");
  }
}

void read_own_coefficients(InputFile& file, HydroLists& lists) {
  const char* keyword = one_of(file, "NCoefMembersCyl", "NCoefMembers");
  const TextTable table = read_table(file, keyword, "coefficients of a member");
  lists.own = index_rows(table, {"MemberID"});
  for (std::size_t i = 0; i < table.size(); ++i) {
    lists.coefficients.push_back(
        {read_pair(table, i, "Member", "1"), read_pair(table, i, "Member", "2")});
  }
}

bool read_flag(const TextTable& table, std::size_t row, TextTable::Names names) {
  const std::string word = to_lower(table.text(row, names));
  if (word == "true" || word == "t") return true;
  if (word == "false" || word == "f" || word == "0") return false;
  throw InputError(table.where(row, names), "must be True or False, got '" + word + "'");
}

HydroMember read_member(const TextTable& table, std::size_t i, const HydroLists& lists,
                        Report& report) {
  HydroMember member;
  member.id = table.integer(i, {"MemberID"});
  constexpr const char* joints[] = {"MJointID1", "MJointID2"};
  constexpr const char* sections[] = {"MPropSetID1", "MPropSetID2"};
  for (std::size_t end = 0; end < 2; ++end) {
    member.joints[end] = look_up(lists.joints, table, i, {joints[end]}, "joint");
    const auto tube = lists.tubes[look_up(lists.sections, table, i, {sections[end]}, "section")];
    member.diameters[end] = tube[0];
    member.walls[end] = tube[1];
  }
  if (table.has({"MSecGeom"}) && table.integer(i, {"MSecGeom"}) != 1) {
    throw InputError(table.where(i, {"MSecGeom"}), "only 1, cylindrical members, are imported");
  }
  member.coefficients = table.integer(i, {"MCoefMod"});
  if (member.coefficients < 1 || member.coefficients > 3) {
    throw InputError(table.where(i, {"MCoefMod"}),
                     fmt::format("must be 1, 2 or 3, got {}", member.coefficients));
  }
  if (member.coefficients == 3) {
    const auto found = lists.own.find(member.id);
    if (found == lists.own.end()) {
      throw InputError(table.where(i, {"MCoefMod"}),
                       fmt::format("there are no coefficients of member {}", member.id));
    }
    member.own = lists.coefficients[found->second];
  }
  member.has_buoyancy = table.number(i, {"MHstLMod"}, 1.0) != 0.0;
  if (!member.has_buoyancy) {
    report.add(assumed, to_string(table.where(i, {"MHstLMod"})) +
                            " = 0: with the pressure of still water that of waves on faces and "
                            "tapers is left out as well");
  }
  member.is_potential = read_flag(table, i, {"PropPot"});
  return member;
}

// Members with sea water up to the still surface are flooded.
void read_fillings(InputFile& file, HydroDyn& hydro) {
  const TextTable table = read_table(file, "NFillGroups", "filling");
  for (std::size_t i = 0; i < table.size(); ++i) {
    const int count = table.integer(i, {"FillNumM"});
    const std::vector<std::string>& words = table.row(i).words;
    if (count < 1 || words.size() < static_cast<std::size_t>(count) + 3) {
      throw InputError(
          table.where(i, {"FillNumM"}),
          fmt::format("{} members, their level and density do not fit on the line", count));
    }
    const auto number = [&](std::size_t at) {
      const auto value = find_number(words[at]);
      if (value) return *value;
      throw InputError(table.where(i, {"FillMList"}), "must be a number, got '" + words[at] + "'");
    };
    const std::size_t after = static_cast<std::size_t>(count) + 1;
    const double level = number(after);
    const bool by_default = to_lower(words[after + 1]) == "default";
    const double density = by_default ? hydro.sea.density : number(after + 1);
    const bool is_sea = std::abs(level - hydro.sea.level) < 1e-3 &&
                        std::abs(density / hydro.sea.density - 1.0) < 1e-3;
    for (std::size_t k = 1; k < after; ++k) {
      const int id = static_cast<int>(number(k));
      const auto found = std::find_if(hydro.members.begin(), hydro.members.end(),
                                      [&](const HydroMember& member) { return member.id == id; });
      if (found == hydro.members.end()) {
        throw InputError(table.where(i, {"FillMList"}), fmt::format("there is no member {}", id));
      }
      found->is_flooded = is_sea;
      const auto place = static_cast<std::size_t>(found - hydro.members.begin());
      hydro.fillings.push_back({place, level, density});
    }
  }
}

// One body with its origin where that of the platform is.
std::optional<HydroPotential> read_potential(InputFile& file, Report& report) {
  const double model = file.number("PotMod", 0.0);
  if (model == 0.0) return {};
  if (model != 1.0) {
    throw InputError(file.where("PotMod"),
                     fmt::format("must be 0, none, or 1, by WAMIT, got {:g}", model));
  }
  if (const double bodies = file.number("NBody", 1.0); bodies != 1.0) {
    throw InputError(file.where("NBody"), fmt::format("one body is imported, not {:g}", bodies));
  }
  for (const char* name : {"PtfmRefxt", "PtfmRefyt", "PtfmRefzt", "PtfmRefztRot"}) {
    if (file.number(name, 0.0) != 0.0) {
      throw InputError(file.where(name), "a body beside the platform's origin is not imported");
    }
  }
  HydroPotential potential;
  potential.root = file.file("PotFile");
  potential.length = file.number("WAMITULEN");
  potential.volume = file.number("PtfmVol0");
  potential.centre_x = file.number("PtfmCOBxt", 0.0);
  potential.centre_y = file.number("PtfmCOByt", 0.0);
  potential.radiates = file.number("RdtnMod", 1.0) != 0.0;
  if (!(potential.length > 0.0) || !(potential.volume >= 0.0)) {
    throw InputError(file.where(potential.length > 0.0 ? "PtfmVol0" : "WAMITULEN"),
                     "length and volume must be > 0");
  }
  if (const double waves = file.number("ExctnMod", 1.0); waves != 1.0) {
    report.add(not_used,
               fmt::format("{}: ExctnMod = {:g}; forces of waves are those of the .3 file",
                           to_string(file.where("ExctnMod")), waves));
  }
  return potential;
}

// A column of six, or a row; and three matrices of six rows each.
HydroAdded read_added(const InputFile& file) {
  constexpr const char* heading = "PLATFORM ADDITIONAL STIFFNESS AND DAMPING";
  HydroAdded added;
  std::vector<double> values;
  int line = 0;
  for (const NumberRow& row : file.numbers_below(heading)) {
    line = row.line;
    values.insert(values.end(), row.values.begin(), row.values.end());
  }
  added.is_zero = std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
  if (added.is_zero) return added;
  constexpr std::size_t matrix = 36, all = 6 + 3 * matrix;
  if (values.size() != all) {
    throw InputError(file.where(line, "AddF0, AddCLin, AddBLin, AddBQuad"),
                     fmt::format("must be {} numbers, found {}", all, values.size()));
  }
  added.preload.assign(values.begin(), values.begin() + 6);
  Mat6* const matrices[] = {&added.stiffness, &added.damping, &added.quadratic};
  for (std::size_t i = 0; i < 3; ++i) {
    const double* first = values.data() + 6 + matrix * i;
    *matrices[i] = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(first);
  }
  return added;
}

void report_rest_of_hydrodyn(InputFile& file, Report& report) {
  for (const char* keyword : {"MnDrift", "NewmanApp", "DiffQTF", "SumQTF"}) {
    if (file.number(keyword, 0.0) == 0.0) continue;
    report.add(not_used, to_string(file.where(keyword)) + ": forces of second order");
  }
  tell_left_out(
      file,
      {{"PtfmRefY", 0.0, "the body of potential flow stands unturned"},
       {"PtfmYMod", 0.0, "the yaw that its waves are seen from stays"},
       {"ExctnDisp", 0.0, "waves act on the body of potential flow at its place in the reference"},
       {"ExctnCutOff", 0.0, "waves act at the place without a filter"}},
      report);
  file.ignore({"AddF0",       "AddCLin",  "AddBLin",   "AddBQuad",  "Echo",        "HDSum",
               "OutAll",      "OutSwtch", "OutFmt",    "OutSFmt",   "NMOutputs",   "NJOutputs",
               "JOutLst",     "HstMod",   "NBodyMod",  "NExctnHdg", "PtfmYCutOff", "RdtnDT",
               "RdtnTMax",    "PotFile",  "WAMITULEN", "PtfmVol0",  "PtfmCOBxt",   "PtfmCOByt",
               "RdtnMod",     "ExctnMod", "NBody",     "PtfmRefxt", "PtfmRefyt",   "PtfmRefzt",
               "PtfmRefztRot"});
  if (file.number("WaveDisp", 1.0) == 0.0) {
    report.add(assumed, to_string(file.where("WaveDisp")) +
                            ": waves at the place without displacement; in the deck at the place "
                            "that is");
  }
}

// SeaState's file: named, or the only one beside this one, or this one.
std::filesystem::path find_seastate(InputFile& file, const Surroundings& surroundings) {
  if (file.has("WaveMod")) return file.path();
  if (!surroundings.seastate.empty()) return surroundings.seastate;
  std::vector<std::filesystem::path> found;
  const auto folder = file.path().has_parent_path() ? file.path().parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file() || to_lower(entry.path().extension().string()) != ".dat") continue;
    const InputFile other(entry.path());
    if (other.has("WaveMod") && other.has("WtrDpth")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  if (found.size() == 1) return found.front();
  std::string names;
  for (const auto& one : found) names += (names.empty() ? "" : ", ") + one.filename().string();
  throw InputError(file.where(0, ""),
                   found.empty() ? "the sea is missing: no file of SeaState is named or beside it"
                                 : "which sea is it: beside it are " + names +
                                       "; a .fst or a driver that names both files decides");
}

}  // namespace

HydroDyn read_hydrodyn(const std::filesystem::path& path, Report& report) {
  return read_hydrodyn(path, find_surroundings(path), report);
}

HydroDyn read_hydrodyn(const std::filesystem::path& path, const Surroundings& surroundings,
                       Report& report) {
  InputFile file(path);
  HydroDyn hydro;
  hydro.path = path;
  hydro.title = file.title();
  hydro.sea = read_seastate(find_seastate(file, surroundings), surroundings, report);
  HydroLists lists;
  read_joints(file, hydro, lists, report);
  read_sections(file, lists);
  hydro.simple = read_simple(file);
  hydro.by_depth = read_by_depth(file);
  read_own_coefficients(file, lists);
  const TextTable members = read_table(file, "NMembers", "member");
  index_rows(members, {"MemberID"});
  for (std::size_t i = 0; i < members.size(); ++i) {
    hydro.members.push_back(read_member(members, i, lists, report));
    const HydroMember& member = hydro.members.back();
    if (member.coefficients == 2 && hydro.by_depth.empty()) {
      throw InputError(members.where(i, {"MCoefMod"}), "there are no coefficients by depth");
    }
    const Vec3 way = hydro.joints[member.joints[1]].place - hydro.joints[member.joints[0]].place;
    if (way.isZero(0.0)) throw InputError(members.where(i, {"MJointID2"}), "it has no length");
  }
  read_growth(file, hydro);
  read_fillings(file, hydro);
  hydro.potential = read_potential(file, report);
  hydro.added = read_added(file);
  report_rest_of_hydrodyn(file, report);
  if (file.number("AMMod", 1.0) == 0.0 && hydro.sea.stretching != "None") {
    report.add(assumed, to_string(file.where("AMMod")) +
                            " = 0: added mass up to the water's surface all the same");
  }
  ignore_sea(file);  // which was part of older files
  report.add(unknown, file.unread());
  check_end(file, report);
  report.add(read, fmt::format("{}: HydroDyn, {} joints, {} members, {} depths with coefficients, "
                               "{} with growth",
                               path.string(), hydro.joints.size(), hydro.members.size(),
                               hydro.by_depth.size(), hydro.growth.size()));
  return hydro;
}

}  // namespace culm::openfast
