#include "turbine_deck.hpp"

#include <culm/math/rotation.hpp>
#include <culm/openfast/deck_writer.hpp>

#include "air_lists.hpp"
#include "blade_lists.hpp"
#include "floater.hpp"
#include "headings.hpp"
#include "hydrodyn_deck.hpp"
#include "sea_lists.hpp"
#include "subdyn_deck.hpp"
#include "turbine_base.hpp"
#include "turbine_cantilevers.hpp"
#include "turbine_layout.hpp"
#include "turbine_report.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace culm::openfast {

namespace {

constexpr BladeMesh blade_mesh{17, 1};
constexpr int tower_elements = 10;
constexpr double standard_gravity = 9.80665;

// A thin steel tube of this mass and bending stiffness where the file does not say more: the report
// of the 5 MW turbine has E = 210 GPa, 8500 kg/m^3 with paint, bolts, welds and flanges.
constexpr double steel = 210e9 / 8500.0;
constexpr double nu = 0.3;

void write_tower_sections(const ElastoDyn& turbine, Report& report, DeckWriter& deck) {
  deck.comment({"Stations of the tower file; d1 is downwind, so EI2 bends along the wind."});
  for (std::size_t i = 0; i < turbine.tower.stations.size(); ++i) {
    const TowerStation& station = turbine.tower.stations[i];
    const double stretch = station.stretch.value_or(station.mass * steel);
    const double shear = stretch / (2.0 * (1.0 + nu)) / 2.0;
    deck.open(fmt::format("tower {}", i + 1), "Stiffness Values");
    deck.set("EA", stretch);
    deck.set("GA1", shear);
    deck.set("GA2", shear);
    deck.set("EI1", station.side_side);
    deck.set("EI2", station.fore_aft);
    deck.set("GIp", fmt::format("torsion*{:.12g}", torsion_of(station)));
    deck.set("rhoA", station.mass);
    deck.set("rhoI1", station.inertia_ss.value_or(station.mass * station.side_side / stretch));
    deck.set("rhoI2", station.inertia_fa.value_or(station.mass * station.fore_aft / stretch));
    deck.close();
  }
  if (!turbine.tower.stations.front().stretch) {
    report.add(assumed,
               "tower: a thin tube of steel, E / rho = 210e9 / 8500 m^2/s^2, nu = 0.3: EA = "
               "mass E / rho, GA = EA / 5.2, rotary inertia mass EI / EA");
  }
  report.add(assumed,
             turbine.tower.stations.front().torsion
                 ? "tower: it twists, GJ from its file; that of ElastoDyn does not"
                 : "tower: it twists, GJ = (EI_fa + EI_ss) / 2.6 as of a thin tube; that of "
                   "ElastoDyn does not: 'Torsion' false of the beam 'tower'");
}

// The first blade that the file of this one describes.
std::size_t first_of_its_file(const ElastoDyn& turbine, std::size_t blade) {
  const auto& path = turbine.blades[blade].beam.path;
  std::size_t first = 0;
  while (turbine.blades[first].beam.path != path) ++first;
  return first;
}

bool is_first_of_its_file(const ElastoDyn& turbine, std::size_t blade) {
  return first_of_its_file(turbine, blade) == blade;
}

// Of a blade that shares its file with others, for which it stands.
std::string name_of(std::size_t blade) {
  return blade == 0 ? "blade" : fmt::format("blade {}", blade + 1);
}

// Blades of one file share their sections.
std::string sections_of(const ElastoDyn& turbine, std::size_t blade) {
  return name_of(first_of_its_file(turbine, blade)) + " station";
}

void write_sections_list(const ElastoDyn& turbine, Report& report, DeckWriter& deck) {
  deck.open("Sections");
  write_tower_sections(turbine, report, deck);
  deck.comment(
      {"Stations of the blades. Order: shear x, shear y, stretch, bending about x (edge) and y",
       "(flap), twist; upper triangle by rows."});
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    if (!is_first_of_its_file(turbine, i)) continue;
    write_sections(sections_of(turbine, i), turbine.blades[i].beam.blade, deck);
  }
  if (turbine.substructure) write_sections(turbine.substructure->frame, deck, report);
  deck.close();
}

void write_body(const std::string& name, const Vec3& position, const Mat3& directors, double mass,
                const Vec3& centre, const Vec3& inertia, DeckWriter& deck) {
  deck.open(name, "Rigid Body");
  deck.set("Position", position);
  if (!directors.isIdentity(0.0)) {
    deck.set("Directors", std::vector<double>(directors.data(), directors.data() + 9));
  }
  deck.set("Mass", mass);
  if (!centre.isZero(0.0)) deck.set("Centre", centre);
  deck.set("Inertia", inertia);
  deck.close();
}

// Generator: a disc on the slow shaft, whose inertia is that of the fast one times the square of
// the ratio. A disc is the slimmest body that has it; what it adds across is taken from the
// nacelle.
void write_bodies(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report,
                  DeckWriter& deck) {
  const double generator = turbine.generator_inertia * turbine.gear_ratio * turbine.gear_ratio;
  const Vec3& centre = turbine.nacelle_centre;
  const double about_centre =
      turbine.nacelle_inertia - turbine.nacelle_mass * centre.head<2>().squaredNorm();
  // a body has extent in all directions
  const double least = 0.01 * std::max(about_centre, 0.0) + turbine.nacelle_mass * 1e-3;
  const double own = std::max(least, about_centre - 0.5 * generator);
  constexpr double token = 1.0;  // a body must weigh something
  const Mat3 along_shaft = triad_along(layout.shaft, layout.nacelle.col(1));
  write_body("nacelle", layout.top, layout.nacelle, turbine.nacelle_mass - token, centre,
             {least, own, own}, deck);
  write_body("generator", layout.place, along_shaft, token, Vec3::Zero(),
             {0.5 * generator, 0.5 * generator, generator}, deck);
  write_body("hub", layout.apex, along_shaft, turbine.hub_mass, {0.0, 0.0, turbine.hub_centre},
             Vec3::Constant(turbine.hub_inertia), deck);
  report.add(assumed,
             fmt::format("generator: {:.6g} kg m^2 about the slow shaft (ratio squared), a "
                         "disc of {:g} kg taken from the nacelle, as far as half of it "
                         "across the shaft",
                         generator, token));
  report.add(assumed,
             fmt::format("nacelle: {:.6g} kg m^2 about its centre from NacYIner; {:.6g} are "
                         "left beside the generator, for pitch as for yaw, 1 % of it for roll",
                         about_centre, own));
  report.add(assumed, "hub: HubIner for all axes");
}

void write_structures(const ElastoDyn& turbine, const TurbineLayout& layout,
                      const std::vector<double>& tower_damping, Report& report, DeckWriter& deck) {
  deck.open("Structures");
  deck.open("tower", "Beam");
  std::vector<std::string> names;
  std::vector<double> heights;
  for (std::size_t i = 0; i < turbine.tower.stations.size(); ++i) {
    names.push_back(fmt::format("tower {}", i + 1));
    heights.push_back(turbine.tower.stations[i].height);
  }
  deck.set("Sections", names);
  deck.set("Section Positions", heights);
  deck.set("Order", blade_mesh.order);
  if (!tower_damping.empty()) deck.set("Strain Damping", tower_damping);
  deck.open("Curve", "Line");
  deck.set("From", layout.base);
  deck.set("To", layout.top);
  deck.set("Up", Vec3(Vec3::UnitX()));
  deck.set("Elements", tower_elements);
  deck.close();
  deck.close();
  write_platform(turbine, deck);
  if (turbine.floater) write_ballast(turbine, deck, report);
  write_bodies(turbine, layout, report, deck);
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    write_beam(fmt::format("blade {}", i + 1), sections_of(turbine, i), turbine.blades[i].beam,
               layout.roots[i], blade_mesh, deck);
  }
  if (turbine.substructure) write_structures(turbine.substructure->frame, deck, report);
  deck.close();
}

void write_masses(const ElastoDyn& turbine, Report& report, DeckWriter& deck) {
  std::vector<std::pair<std::string, double>> found;
  if (turbine.yaw_bearing_mass > 0.0) found.emplace_back("tower/last", turbine.yaw_bearing_mass);
  for (std::size_t i = 0; i < turbine.tip_masses.size(); ++i) {
    if (turbine.tip_masses[i] > 0.0) {
      found.emplace_back(fmt::format("blade {}/last", i + 1), turbine.tip_masses[i]);
    }
  }
  if (found.empty() && !turbine.substructure) return;
  deck.open("Masses");
  if (turbine.substructure) write_masses(turbine.substructure->frame, deck, report);
  for (const auto& [node, mass] : found) {
    deck.open("at " + node, "Point Mass");
    deck.set("Node", node);
    deck.set("Mass", mass);
    deck.close();
  }
  deck.close();
}

void write_follower(const std::string& name, const std::string& node, const std::string& master,
                    DeckWriter& deck) {
  deck.open(name, "Rigid Connection");
  deck.set("Node", node);
  deck.set("Master", master);
  deck.close();
}

// Entries between two nodes about an axis.
void open_about(const Vec3& axis, const std::string& name, const std::string& type,
                const std::string& first, const std::string& second, DeckWriter& deck) {
  deck.open(name, type);
  deck.set("First", first);
  deck.set("Second", second);
  deck.set("Axis", axis);
}

// The tower may begin beside the joint that carries it.
void report_gap(const ElastoDyn& turbine, Report& report) {
  const SubDyn& frame = turbine.substructure->frame;
  const SubJoint& carrier = frame.joints[frame.interface.front()];
  const Vec3 arm = Vec3(0.0, 0.0, turbine.tower_base) - carrier.place;
  if (frame.interface.size() > 1 ? std::abs(arm.z()) < 1e-3 : arm.norm() < 1e-3) return;
  report.add(assumed,
             fmt::format("{:.3g} m between the foot of the tower and joint {} are rigid",
                         frame.interface.size() > 1 ? std::abs(arm.z()) : arm.norm(), carrier.id));
}

void write_foundation(const ElastoDyn& turbine, Report& report, DeckWriter& deck) {
  const bool has_platform = turbine.platform.mass > 0.0;
  if (turbine.substructure) {
    write_constraints(turbine.substructure->frame, deck, report);
    const std::string carrier = interface_node(turbine.substructure->frame);
    write_follower("transition", "tower/first", carrier, deck);
    report_gap(turbine, report);
    if (has_platform) write_follower("platform", "platform", carrier, deck);
    return;
  }
  if (turbine.floater) {
    write_held_freedoms(turbine, deck);
    write_ballast_support(turbine, deck);
    write_follower("transition", "tower/first", "platform", deck);
    return;
  }
  if (stands_on_more(turbine)) deck.comment(describe_base(turbine));
  deck.open("foundation", "Rigid Support");
  deck.set("Node", has_platform ? "platform" : "tower/first");
  deck.close();
  if (has_platform) write_follower("transition", "tower/first", "platform", deck);
}

void write_yaw_bearing(const ElastoDyn& turbine, const TurbineLayout& layout, DeckWriter& deck) {
  if (turbine.yaws()) {
    open_about(Vec3::UnitZ(), "yaw bearing", "Revolute Joint", "tower/last", "nacelle", deck);
    deck.set("Position", layout.top);
    deck.close();
    return;
  }
  deck.comment({why_locked(turbine)});
  write_follower("yaw bearing", "nacelle", "tower/last", deck);
}

void write_constraints(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report,
                       DeckWriter& deck) {
  deck.open("Constraints");
  write_foundation(turbine, report, deck);
  write_yaw_bearing(turbine, layout, deck);
  open_about(layout.shaft, "generator bearing", "Revolute Joint", "nacelle", "generator", deck);
  deck.close();
  deck.comment({"The generator is locked; with an angle and a function it turns as prescribed."});
  open_about(layout.shaft, "generator", "Joint Angle", "nacelle", "generator", deck);
  deck.set("Angle", 0.0);
  deck.close();
  if (turbine.air) write_rotation(layout, deck);
  if (turbine.shaft_stiffness > 0.0) {
    open_about(layout.shaft, "shaft bearing", "Revolute Joint", "generator", "hub", deck);
    deck.close();
  } else {
    write_follower("shaft", "hub", "generator", deck);
  }
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    const std::string name = fmt::format("blade {}", i + 1);
    write_follower(name, name + "/first", "hub", deck);
  }
  deck.close();
}

void write_loads(const ElastoDyn& turbine, const TurbineLayout& layout,
                 const std::filesystem::path& folder, Report& report, DeckWriter& deck) {
  deck.open("Loads");
  deck.open("weight", "Gravity");
  deck.set("Acceleration", Vec3(0.0, 0.0, -turbine.gravity.value_or(standard_gravity)));
  deck.close();
  if (turbine.yaws()) {
    open_about(Vec3::UnitZ(), "yaw spring", "Torsion Spring", "tower/last", "nacelle", deck);
    deck.set("Stiffness", turbine.yaw_drive->stiffness);
    deck.close();
  }
  if (turbine.yaws() && turbine.yaw_drive->damping > 0.0) {
    open_about(Vec3::UnitZ(), "yaw damper", "Torsion Damper", "tower/last", "nacelle", deck);
    deck.set("Damping", turbine.yaw_drive->damping);
    deck.close();
  }
  if (turbine.shaft_stiffness > 0.0) {
    open_about(layout.shaft, "shaft spring", "Torsion Spring", "generator", "hub", deck);
    deck.set("Stiffness", turbine.shaft_stiffness);
    deck.close();
  }
  if (turbine.shaft_stiffness > 0.0 && turbine.shaft_damping > 0.0) {
    open_about(layout.shaft, "shaft damper", "Torsion Damper", "generator", "hub", deck);
    deck.set("Damping", turbine.shaft_damping);
    deck.close();
  }
  if (turbine.air) write_air_loads(turbine, layout, report, deck);
  if (turbine.floater) write_floater_loads(turbine, folder, deck, report);
  if (turbine.substructure) {
    const Substructure& base = *turbine.substructure;
    write_cables(base.frame, deck, report);
    write_ground(base.frame, deck, report);
    if (base.water) write_members(*base.water, base.frame, deck, report);
    if (base.water && base.water->sea.kind != SeaState::Kind::still) {
      report.add(assumed, "weight and modes see the waves as they stand at time 0");
    }
  }
  deck.close();
}

void write_analyses(const ElastoDyn& turbine, DeckWriter& deck) {
  const std::vector<std::string> air =
      turbine.air ? names_of_air(turbine) : std::vector<std::string>{};
  deck.open("Analyses");
  deck.open("weight", "Static");
  deck.set("Steps", 2);
  if (turbine.air) deck.set("Inactive", air);
  deck.close();
  deck.open("modes", "Modal");
  deck.set("Modes", 15);
  if (turbine.air) deck.set("Inactive", air);
  deck.close();
  if (turbine.air) write_operation(deck);
  deck.close();
}

void write_history(const std::string& name, const std::string& type, const std::string& node,
                   DeckWriter& deck) {
  deck.open(name, type);
  deck.set("Node", node);
  deck.close();
}

void write_output(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report,
                  DeckWriter& deck) {
  deck.open("Output");
  if (turbine.air) deck.set("Every", 50);
  deck.open("History");
  write_history("tower top", "Displacement", "tower/last", deck);
  if (turbine.substructure) {
    write_history(turbine.substructure->frame, deck, report);
  } else if (turbine.floater) {
    write_floater_history(turbine, deck);
  } else {
    write_history("tower base", "Reaction",
                  turbine.platform.mass > 0.0 ? "platform" : "tower/first", deck);
  }
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    const std::string name = fmt::format("blade {}", i + 1);
    write_history(name + " tip", "Displacement", name + "/last", deck);
  }
  open_about(layout.shaft, "rotor", "Joint Angle", "nacelle", "hub", deck);
  deck.close();
  if (turbine.air) write_air_history(turbine, deck);
  deck.open("energy", "Energy");
  deck.close();
  deck.close();
  deck.close();
}

// The comment at the top.
std::vector<std::string> about(const ElastoDyn& turbine) {
  std::vector<std::string> lines{
      "Shows: a wind turbine under its weight, generator locked, and its modes.",
      "Imported from " + turbine.path.filename().string() + " of OpenFAST."};
  lines.push_back(
      turbine.tower_base == 0.0 && turbine.platform.reference.isZero(0.0)
          ? "x downwind, z up; origin at the foot of the tower. SI units."
          : fmt::format("x downwind, z up from ground or mean sea level; the foot of the "
                        "tower is at z = {:g} m. SI units.",
                        turbine.tower_base));
  if (turbine.substructure) {
    lines.push_back("It stands on the substructure of " +
                    turbine.substructure->frame.path.filename().string() + ".");
  } else if (turbine.floater) {
    lines.push_back("It floats on the platform of " +
                    turbine.floater->water.path.filename().string() + ".");
  } else if (stands_on_more(turbine)) {
    lines.emplace_back("What is below the tower is not in this deck: see 'foundation'.");
  }
  return lines;
}

}  // namespace

void scale_blades(ElastoDyn& turbine, double mass, Report& report) {
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    BeamDyn& beam = turbine.blades[i].beam;
    const double factor = mass / blade_mass(beam);
    for (BladeStation& station : beam.blade.stations) station.mass *= factor;
    report.add(assumed,
               fmt::format("blade {}: masses times {:.6g}, for {:g} kg", i + 1, factor, mass));
  }
}

void replace_blades(ElastoDyn& turbine, const std::vector<BeamDyn>& blades, Report& report) {
  const double wanted = turbine.tip_radius - turbine.hub_radius;
  report.add(assumed,
             "blades: those of BeamDyn; what ElastoDyn's blade files say is left out but for "
             "the mode shapes, and the damping of blades that have none of their own");
  if (std::ranges::any_of(turbine.tip_masses, [](double mass) { return mass > 0.0; })) {
    report.add(not_used,
               "masses at the tips of blades, TipMass: ElastoDyn's blades have them only");
  }
  std::ranges::fill(turbine.tip_masses, 0.0);
  for (std::size_t i = 0; i < blades.size(); ++i) {
    turbine.blades[i].beam = blades[i];
    const auto& damping = blades[i].blade.damping;
    if (is_first_of_its_file(turbine, i) && damping == std::array<double, 6>{}) {
      report.add(assumed, fmt::format("{}: without damping by mu it has that of ElastoDyn's blade",
                                      blades[i].path.string()));
    }
    const double length = BladeAxis(blades[i].key_points).curve.length();
    if (!is_first_of_its_file(turbine, i) || std::abs(length - wanted) <= 1e-3 * wanted) continue;
    report.add(unknown, fmt::format("{}: the blade is {:.6g} m long, TipRad - HubRad is {:.6g} m",
                                    blades[i].path.string(), length, wanted));
  }
}

std::vector<Variant> variants_of(const ElastoDyn& turbine) {
  const std::string rigid = "Structures/tower/Torsion=false";
  const std::vector<std::string> locked{
      "Constraints/yaw lock/Type=Joint Angle", "Constraints/yaw lock/First=tower/last",
      "Constraints/yaw lock/Second=nacelle", "Constraints/yaw lock/Axis={0, 0, 1}",
      "Constraints/yaw lock/Angle=0"};
  if (!turbine.yaws()) return {{"tower does not twist", {rigid}}};
  std::vector<std::string> both = locked;
  both.push_back(rigid);
  return {{"yaw locked", locked}, {"and no twist", both}};
}

std::vector<std::string> only_modes_of(const ElastoDyn& turbine) {
  return turbine.air ? std::vector<std::string>{"end=step"} : std::vector<std::string>{};
}

std::string write_deck(ElastoDyn turbine, const std::filesystem::path& folder, Report& report) {
  report_conventions(report);
  report.add(conventions,
             "turbine: x downwind, z up; azimuth and generator turn about the shaft, "
             "clockwise seen from upwind; pitch turns about -z of the blade, cone about y");
  find_blade_damping(turbine, report);
  const std::vector<double> tower_damping = find_tower_damping(turbine, report);
  report.add(assumed, fmt::format("mesh: {} elements per blade, {} in the tower, of order {}",
                                  blade_mesh.elements, tower_elements, blade_mesh.order));
  if (!turbine.gravity) {
    report.add(assumed, fmt::format("gravity {:g} m/s^2, which ElastoDyn's files do not have",
                                    standard_gravity));
  }
  if (!turbine.air) {
    report.add(not_used,
               fmt::format("RotSpeed, {:.5g} rad/s: the rotor stands still", turbine.rotor_speed));
  }
  report_masses(turbine, report);
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    if (is_first_of_its_file(turbine, i)) report_blade(name_of(i), turbine.blades[i].beam, report);
  }
  const TurbineLayout layout(turbine);
  report_yaw(turbine, layout, report);
  if (stands_on_more(turbine)) {
    for (const std::string& line : describe_base(turbine)) report.add(missing, line);
  }
  if (turbine.substructure) report_masses(turbine.substructure->frame, report);
  DeckWriter deck(turbine.title, about(turbine));
  deck.variable("torsion", 1.0, "times GJ of the tower");
  if (turbine.air) write_air_variables(turbine, deck);
  write_sections_list(turbine, report, deck);
  if (turbine.air) {
    write_air(turbine, folder, report, deck);
  } else if (const SeaState* sea = turbine.sea()) {
    write_flows(*sea, deck);
  }
  write_structures(turbine, layout, tower_damping, report, deck);
  write_masses(turbine, report, deck);
  write_constraints(turbine, layout, report, deck);
  write_loads(turbine, layout, folder, report, deck);
  if (turbine.air) write_initial_velocities(turbine, layout, deck);
  write_analyses(turbine, deck);
  write_output(turbine, layout, report, deck);
  return deck.text();
}

}  // namespace culm::openfast
