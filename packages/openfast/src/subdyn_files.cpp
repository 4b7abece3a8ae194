#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/math/rotation.hpp>
#include <culm/openfast/subdyn.hpp>
#include <culm/openfast/text_table.hpp>

#include "entries.hpp"
#include "file_end.hpp"
#include "ground_file.hpp"
#include "headings.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

namespace culm::openfast {

namespace {

double non_negative(const TextTable& table, std::size_t row, TextTable::Names names) {
  const double value = table.number(row, names);
  if (value >= 0.0) return value;
  throw InputError(table.where(row, names), fmt::format("must be >= 0, got {:g}", value));
}

// Whether there is a table that files of some years do not have, not even its heading.
bool has_lines(InputFile& file, const char* keyword, const char* heading) {
  if (!file.has(keyword) && !file.has_heading(heading)) return false;
  return read_table(file, keyword, heading).size() > 0;
}

SubJoint read_joint(const TextTable& table, std::size_t i) {
  constexpr SubJoint::Kind kinds[] = {SubJoint::Kind::rigid, SubJoint::Kind::universal,
                                      SubJoint::Kind::revolute, SubJoint::Kind::spherical};
  SubJoint joint;
  joint.id = table.integer(i, {"JointID"});
  joint.place = {table.number(i, {"JointXss"}), table.number(i, {"JointYss"}),
                 table.number(i, {"JointZss"})};
  if (!table.has({"JointType"})) return joint;
  const int kind = table.integer(i, {"JointType"});
  if (kind < 1 || kind > 4) {
    throw InputError(table.where(i, {"JointType"}),
                     fmt::format("must be 1 (rigid), 2 (universal), 3 (revolute) or 4 (spherical), "
                                 "got {}",
                                 kind));
  }
  joint.kind = kinds[kind - 1];
  if (joint.kind == SubJoint::Kind::universal) {
    throw InputError(table.where(i, {"JointType"}), "universal joints are not imported");
  }
  joint.axis = {table.number(i, {"JointDirX"}), table.number(i, {"JointDirY"}),
                table.number(i, {"JointDirZ"})};
  if (joint.kind == SubJoint::Kind::revolute && joint.axis.isZero(0.0)) {
    throw InputError(table.where(i, {"JointDirX"}), "the axis of a revolute joint must not be 0");
  }
  const double stiffness = table.number(i, {"JointStiff"}, 0.0);
  if (joint.kind != SubJoint::Kind::rigid && stiffness != 0.0) {
    throw InputError(table.where(i, {"JointStiff"}),
                     "joints with a stiffness are not imported; must be 0");
  }
  return joint;
}

SubSection read_tube(const TextTable& table, std::size_t i) {
  SubSection section;
  section.id = table.integer(i, {"PropSetID"});
  section.is_tube = true;
  section.young = positive(table, i, {"YoungE"});
  section.shear = positive(table, i, {"ShearG", "ShearG1"});
  section.density = non_negative(table, i, {"MatDens"});
  section.diameter = positive(table, i, {"XsecD"});
  section.wall = positive(table, i, {"XsecT"});
  const double outer = 0.5 * section.diameter, inner = outer - section.wall;
  if (inner < 0.0) {
    throw InputError(
        table.where(i, {"XsecT"}),
        fmt::format("must be at most half the diameter, {:g} m, got {:g} m", outer, section.wall));
  }
  section.area = std::numbers::pi * (outer * outer - inner * inner);
  return section;
}

SubSection read_arbitrary(const TextTable& table, std::size_t i) {
  SubSection section;
  section.id = table.integer(i, {"PropSetID"});
  section.young = positive(table, i, {"YoungE"});
  section.shear = positive(table, i, {"ShearG", "ShearG1"});
  section.density = non_negative(table, i, {"MatDens"});
  section.area = positive(table, i, {"XsecA"});
  section.shear_area = {positive(table, i, {"XsecAsx"}), positive(table, i, {"XsecAsy"})};
  section.bending = {positive(table, i, {"XsecJxx"}), positive(table, i, {"XsecJyy"})};
  section.twist = positive(table, i, {"XsecJt", "XsecJ0"});
  return section;
}

// Axis x of the sections of a member: horizontal, and to the right of its horizontal direction;
// that of space where the member is vertical. @source theory manual of SubDyn
Vec3 usual_x(const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double across = std::hypot(way.x(), way.y());
  if (across <= 1e-9 * way.norm()) return Vec3::UnitX();
  return {way.y() / across, -way.x() / across, 0.0};
}

// What members refer to.
struct SubLists {
  std::map<int, std::size_t> joints, tubes, arbitrary, cables, rigid, axes;
  std::vector<Vec3> x;  ///< of the matrices of directions
};

// Kinds of older files, which have tubes only, of 1 to 4, and of newer ones: 1c, 1r.
std::string kind_of(const TextTable& table, std::size_t i) {
  return table.has({"MType"}) ? to_lower(table.text(i, {"MType"})) : "1";
}

SubMember read_member(const TextTable& table, std::size_t i, const SubLists& lists, SubDyn& sub) {
  SubMember member;
  member.id = table.integer(i, {"MemberID"});
  member.joints = {look_up(lists.joints, table, i, {"MJointID1"}, "joint"),
                   look_up(lists.joints, table, i, {"MJointID2"}, "joint")};
  if (!(length_of(sub, member) > 0.0)) {
    throw InputError(table.where(i, {"MJointID2"}), "the member has no length");
  }
  const std::string kind = kind_of(table, i);
  const std::map<int, std::size_t>* rows = nullptr;
  if (kind == "1" || kind == "1c") {
    rows = &lists.tubes;
  } else if (kind == "2") {
    rows = &lists.cables;
    member.kind = SubMember::Kind::cable;
  } else if (kind == "3") {
    rows = &lists.rigid;
    member.kind = SubMember::Kind::rigid;
  } else if (kind == "4") {
    rows = &lists.arbitrary;
  } else {
    throw InputError(table.where(i, {"MType"}),
                     "'" + kind +
                         "' is not imported (allowed: 1 or 1c circular, 2 cable, 3 rigid, 4 "
                         "arbitrary)");
  }
  member.properties = {look_up(*rows, table, i, {"MPropSetID1"}, "property set"),
                       look_up(*rows, table, i, {"MPropSetID2"}, "property set")};
  member.x = usual_x(sub.joints[member.joints[0]].place, sub.joints[member.joints[1]].place);
  if (!table.optional_text(i, {"COSMID"}).empty() && table.integer(i, {"COSMID"}) > 0) {
    member.x = lists.x[look_up(lists.axes, table, i, {"COSMID"}, "matrix")];
    const Vec3 way = sub.joints[member.joints[1]].place - sub.joints[member.joints[0]].place;
    if (std::abs(member.x.dot(way)) > 1e-2 * way.norm()) {
      throw InputError(table.where(i, {"COSMID"}),
                       "the first row of its matrix must be across the member");
    }
  }
  if (kind == "4" && table.has({"MSpin", "MSpin/COSMID"})) {
    const double spin = table.number(i, {"MSpin", "MSpin/COSMID"});
    const Vec3 way = sub.joints[member.joints[1]].place - sub.joints[member.joints[0]].place;
    member.x = Eigen::AngleAxisd(spin * std::numbers::pi / 180.0, way.normalized()) * member.x;
  }
  return member;
}

// Files exist that call both this count and that of circular sections NPropSets.
void refuse_rectangles(InputFile& file) {
  const bool is_named = file.has("NPropSetsRec");
  if (!is_named && !file.has_heading("RECTANGULAR BEAM")) return;
  const auto rows = is_named ? std::vector<TextRow>() : file.rows_below("RECTANGULAR BEAM");
  const int line = rows.empty() ? 0 : rows.front().line;
  const bool is_none = is_named ? file.integer("NPropSetsRec") == 0
                                : !rows.empty() && rows.front().words.front() == "0";
  if (is_none) return;
  throw InputError(is_named ? file.where("NPropSetsRec") : file.where(line, "NPropSets"),
                   "rectangular sections are not imported; must be 0");
}

void read_sections(InputFile& file, SubDyn& sub, SubLists& lists) {
  const char* tubes = file.has("NPropSetsCyl") ? "NPropSetsCyl" : "NPropSets";
  const TextTable circular = read_table(file, tubes, "circular section");
  lists.tubes = index_rows(circular, {"PropSetID"});
  for (std::size_t i = 0; i < circular.size(); ++i) sub.sections.push_back(read_tube(circular, i));
  refuse_rectangles(file);
  if (has_lines(file, "NXPropSets", "ARBITRARY BEAM")) {
    const TextTable table = read_table(file, "NXPropSets", "arbitrary section");
    for (const auto& [id, row] : index_rows(table, {"PropSetID"})) {
      lists.arbitrary[id] = row + circular.size();
    }
    for (std::size_t i = 0; i < table.size(); ++i) sub.sections.push_back(read_arbitrary(table, i));
  }
}

void read_links(InputFile& file, SubDyn& sub, SubLists& lists) {
  if (has_lines(file, "NCablePropSets", "CABLE PROPERTIES")) {
    const TextTable table = read_table(file, "NCablePropSets", "cable");
    lists.cables = index_rows(table, {"PropSetID"});
    for (std::size_t i = 0; i < table.size(); ++i) {
      sub.cables.push_back({table.integer(i, {"PropSetID"}), positive(table, i, {"EA"}),
                            non_negative(table, i, {"MatDens"}), table.number(i, {"T0"})});
    }
  }
  if (has_lines(file, "NRigidPropSets", "RIGID LINK PROPERTIES")) {
    const TextTable table = read_table(file, "NRigidPropSets", "rigid link");
    lists.rigid = index_rows(table, {"PropSetID"});
    for (std::size_t i = 0; i < table.size(); ++i) {
      sub.rigid_links.push_back(
          {table.integer(i, {"PropSetID"}), 0.0, non_negative(table, i, {"MatDens"}), 0.0});
    }
  }
  if (has_lines(file, "NSpringPropSets", "SPRING ELEMENT")) {
    throw InputError(file.where("NSpringPropSets"), "spring elements are not imported; must be 0");
  }
}

void read_axes(InputFile& file, SubLists& lists) {
  if (!has_lines(file, "NCOSMs", "MEMBER COSINE")) return;
  const TextTable table = read_table(file, "NCOSMs", "matrix of directions");
  lists.axes = index_rows(table, {"COSMID"});
  for (std::size_t i = 0; i < table.size(); ++i) {
    // rows of the matrix are the axes of the member
    const Vec3 x(table.number(i, {"COSM11"}), table.number(i, {"COSM12"}),
                 table.number(i, {"COSM13"}));
    if (std::abs(x.norm() - 1.0) > 1e-3) {
      throw InputError(table.where(i, {"COSM11"}), "its first row must be of length 1");
    }
    lists.x.push_back(x);
  }
}

// The mass of the ground becomes one of the concentrated masses, if a body can have it.
void read_ground_at(const std::filesystem::path& path, SubSupport& support, SubDyn& sub,
                    Report& report) {
  const Ground ground = read_ground(path, report);
  support.stiffness = ground.stiffness;
  if (!support.is_soft()) {
    report.add(not_used, path.string() + ": what is held does not move on the ground");
    return;
  }
  if (ground.mass.isZero(0.0)) return;
  const double mass = ground.mass(0, 0);
  const Vec3 centre = mass > 0.0 ? Vec3(ground.mass(1, 5) / mass, -ground.mass(0, 5) / mass,
                                        ground.mass(0, 4) / mass)
                                 : Vec3::Zero();
  const Mat3 arm = skew(centre);
  Mat6 body;
  body << mass * Mat3::Identity(), -mass * arm, mass * arm, ground.mass.bottomRightCorner<3, 3>();
  if (!(mass > 0.0) || !body.isApprox(ground.mass, 1e-6)) {
    report.add(missing, fmt::format("{}: its mass, along x {:g} kg, is not that of a body",
                                    path.string(), mass));
    return;
  }
  sub.masses.push_back(
      {support.joint, mass, centre, body.bottomRightCorner<3, 3>() + mass * arm * arm});
  report.add(assumed, fmt::format("{}: its mass of {:g} kg is a concentrated one, which weighs; "
                                  "that of SubDyn does not",
                                  path.string(), mass));
}

void read_supports(InputFile& file, SubDyn& sub, const SubLists& lists, Report& report) {
  constexpr const char* flags[] = {"RctTDXss", "RctTDYss", "RctTDZss",
                                   "RctRDXss", "RctRDYss", "RctRDZss"};
  if (!has_lines(file, "NReact", "BASE REACTION")) return;
  const TextTable table = read_table(file, "NReact", "reaction joint");
  index_rows(table, {"RJointID"});
  for (std::size_t i = 0; i < table.size(); ++i) {
    SubSupport support{look_up(lists.joints, table, i, {"RJointID"}, "joint"), {}};
    for (std::size_t k = 0; k < 6; ++k) support.held[k] = table.integer(i, {flags[k]}) != 0;
    const std::string ground = table.optional_text(i, {"SSIfile"});
    if (!ground.empty()) read_ground_at(file.beside(ground), support, sub, report);
    sub.supports.push_back(support);
  }
}

void read_interface(InputFile& file, SubDyn& sub, const SubLists& lists, Report& report) {
  constexpr const char* flags[] = {"ItfTDXss", "ItfTDYss", "ItfTDZss",
                                   "ItfRDXss", "ItfRDYss", "ItfRDZss"};
  if (!has_lines(file, "NInterf", "INTERFACE JOINTS")) return;
  const TextTable table = read_table(file, "NInterf", "interface joint");
  for (std::size_t i = 0; i < table.size(); ++i) {
    sub.interface.push_back(look_up(lists.joints, table, i, {"IJointID"}, "joint"));
    for (const char* flag : flags) {
      if (!table.has({flag}) || table.integer(i, {flag}) != 0) continue;
      report.add(assumed, to_string(table.where(i, {flag})) + ": is free; locked in the deck");
    }
  }
}

void read_masses(InputFile& file, SubDyn& sub, const SubLists& lists) {
  if (!has_lines(file, "NCmass", "CONCENTRATED MASSES")) return;
  const TextTable table = read_table(file, "NCmass", "concentrated mass");
  for (std::size_t i = 0; i < table.size(); ++i) {
    SubMass one;
    one.joint = look_up(lists.joints, table, i, {"CMJointID"}, "joint");
    one.mass = non_negative(table, i, {"JMass"});
    const double xx = non_negative(table, i, {"JMXX"}), yy = non_negative(table, i, {"JMYY"}),
                 zz = non_negative(table, i, {"JMZZ"});
    const double xy = table.number(i, {"JMXY"}, 0.0), xz = table.number(i, {"JMXZ"}, 0.0),
                 yz = table.number(i, {"JMYZ"}, 0.0);
    one.inertia << xx, xy, xz,  //
        xy, yy, yz,             //
        xz, yz, zz;
    one.centre = {table.number(i, {"MCGX"}, 0.0), table.number(i, {"MCGY"}, 0.0),
                  table.number(i, {"MCGZ"}, 0.0)};
    sub.masses.push_back(one);
  }
}

void read_settings(InputFile& file, SubDyn& sub, Report& report) {
  sub.divisions = file.integer("NDiv");
  if (sub.divisions < 1) {
    throw InputError(file.where("NDiv"), fmt::format("must be >= 1, got {}", sub.divisions));
  }
  if (file.number("FEMMod", 3.0) == 1.0) {
    report.add(assumed, to_string(file.where("FEMMod")) +
                            ": elements without shear; in the deck beams have it");
  }
  // files of some years have neither this switch nor the factors
  const int guyan = file.has("RayleighDamp") ? file.integer("GuyanDampMod") : 0;
  if (guyan < 0 || guyan > 2) {
    throw InputError(file.where("GuyanDampMod"), fmt::format("must be 0, 1 or 2, got {}", guyan));
  }
  if (guyan == 1) {
    const std::vector<double> damping = file.numbers("RayleighDamp");
    if (damping.size() != 2) {
      throw InputError(file.where("RayleighDamp"),
                       fmt::format("must be 2 numbers, got {}", damping.size()));
    }
    sub.damping = damping[1];
    if (damping[0] != 0.0) {
      report.add(not_used, to_string(file.where("RayleighDamp")) +
                               fmt::format(": damping by mass, {:g} 1/s", damping[0]));
    }
  }
  if (guyan == 2) {
    report.add(not_used,
               to_string(file.where("GuyanDampMod")) + ": a matrix of damping at the interface");
  }
  if (file.number("JDampings", 0.0) != 0.0) {
    report.add(not_used, to_string(file.where("JDampings")) +
                             ": damping of modes; give 'Damping' to the beams");
  }
  file.ignore({"Echo",        "SDdeltaT",    "IntMethod",    "SttcSolve",     "GuyanLoadCorrection",
               "CBMod",       "Nmodes",      "RayleighDamp", "GuyanDampSize", "SumPrint",
               "OutCBModes",  "OutFEMModes", "OutCOSM",      "OutAll",        "OutSwtch",
               "TabDelim",    "OutDec",      "OutFmt",       "OutSFmt",       "NMOutputs",
               "ExtraMoment", "ReadWaterKin"});
}

void report_content(const SubDyn& sub, Report& report) {
  report.add(
      read,
      fmt::format("{}: SubDyn, {} joints, {} members, {} sections, {} reaction joints, "
                  "{} interface joints, {} concentrated masses",
                  sub.path.string(), sub.joints.size(), sub.members.size(), sub.sections.size(),
                  sub.supports.size(), sub.interface.size(), sub.masses.size()));
}

}  // namespace

double length_of(const SubDyn& file, const SubMember& member) {
  return (file.joints[member.joints[1]].place - file.joints[member.joints[0]].place).norm();
}

double mass_of(const SubDyn& file, const SubMember& member) {
  const auto [first, second] = member.properties;
  const double length = length_of(file, member);
  if (member.kind == SubMember::Kind::cable) return file.cables[first].density * length;
  if (member.kind == SubMember::Kind::rigid) return file.rigid_links[first].density * length;
  const SubSection &a = file.sections[first], &b = file.sections[second];
  return 0.5 * (a.area * a.density + b.area * b.density) * length;
}

SubDyn read_subdyn(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  SubDyn sub;
  sub.path = path;
  sub.title = file.title();
  read_settings(file, sub, report);
  SubLists lists;
  const TextTable joints = read_table(file, "NJoints", "joint");
  lists.joints = index_rows(joints, {"JointID"});
  for (std::size_t i = 0; i < joints.size(); ++i) sub.joints.push_back(read_joint(joints, i));
  read_supports(file, sub, lists, report);
  read_interface(file, sub, lists, report);
  read_sections(file, sub, lists);
  read_links(file, sub, lists);
  read_axes(file, lists);
  const TextTable members = read_table(file, "NMembers", "member");
  index_rows(members, {"MemberID"});
  for (std::size_t i = 0; i < members.size(); ++i) {
    sub.members.push_back(read_member(members, i, lists, sub));
  }
  if (sub.members.empty()) throw InputError(file.where("NMembers"), "must be at least 1");
  read_masses(file, sub, lists);
  report_content(sub, report);
  report.add(unknown, file.unread());
  check_end(file, report);
  return sub;
}

}  // namespace culm::openfast
