#include "beamdyn_deck.hpp"

#include <culm/base/text.hpp>
#include <culm/openfast/deck_writer.hpp>

#include "blade_lists.hpp"
#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::openfast {

namespace {

constexpr const char* blade = "blade";
constexpr BladeMesh mesh;

std::vector<std::string> heading(const std::string& what, const std::filesystem::path& path,
                                 const BeamDyn& beam) {
  return {
      "Shows: " + what,
      "Imported from " + path.filename().string() + ", " + beam.path.filename().string() + " and " +
          beam.blade.path.filename().string() + " of OpenFAST.",
      "'" + beam.title + "'",
      "Axes of the blade root: x towards the suction side, y towards the trailing edge, z to the "
      "tip. SI units."};
}

void write_blade(const BeamDyn& beam, const Placement& placement, DeckWriter& deck) {
  deck.open("Sections");
  deck.comment({"Stations of the blade file. Order: shear x, shear y, stretch, bending about x",
                "(edge) and y (flap), twist; upper triangle by rows."});
  write_sections(blade, beam.blade, deck);
  deck.close();
  deck.open("Structures");
  write_beam(blade, blade, beam, placement, mesh, deck);
  deck.close();
}

void watch_blade(const std::string& name, const std::string& type, const std::string& node,
                 DeckWriter& deck) {
  deck.open(name, type);
  deck.set("Node", node);
  deck.close();
}

void write_output(bool dynamic, int every, DeckWriter& deck) {
  deck.open("Output");
  if (every > 1) deck.set("Every", every);
  deck.open("History");
  watch_blade("tip", "Displacement", "blade/last", deck);
  watch_blade("tip rotation", "Rotation", "blade/last", deck);
  watch_blade("root", "Reaction", "blade/first", deck);
  if (dynamic) {
    deck.open("energy", "Energy");
    deck.close();
  }
  deck.close();
  deck.close();
}

// The load, and the modes about the state that it makes.
void write_static(bool modes, DeckWriter& deck) {
  deck.open("Analyses");
  deck.open("bending", "Static");
  deck.set("Steps", 4);
  deck.close();
  if (modes) {
    deck.open("modes", "Modal");
    deck.set("Modes", 10);
    deck.close();
  }
  deck.close();
}

// One load on a node or along the blade, if it is not zero.
void write_load(const std::string& name, const std::string& type, const std::string& quantity,
                const std::pair<std::string, std::string>& place, const Vec3& value, bool dynamic,
                DeckWriter& deck) {
  if (value.isZero(0.0)) return;
  deck.open(name, type);
  deck.set(place.first, place.second);
  deck.set(quantity, value);
  if (dynamic) deck.set("Function", "Constant");
  deck.close();
}

// Ends and middle by name, which stay if the mesh is changed.
std::string name_node(int node) {
  const int last = mesh.elements * mesh.order;
  if (node == last) return fmt::format("{}/last", blade);
  return 2 * node == last ? fmt::format("{}/middle", blade) : fmt::format("{}/{}", blade, node);
}

void write_loads(const BeamDynDriver& driver, Report& report, DeckWriter& deck) {
  deck.open("Loads");
  if (!driver.gravity.isZero(0.0)) {
    deck.open("weight", "Gravity");
    deck.set("Acceleration", driver.gravity);
    deck.close();
  }
  const std::pair<std::string, std::string> along{"Structure", blade};
  write_load("force along the blade", "Line Force", "Force", along, driver.line_force,
             driver.dynamic, deck);
  write_load("moment along the blade", "Line Moment", "Moment", along, driver.line_moment,
             driver.dynamic, deck);
  const int last = mesh.elements * mesh.order;
  for (std::size_t i = 0; i < driver.point_loads.size(); ++i) {
    const PointLoad& load = driver.point_loads[i];
    const int node = static_cast<int>(std::lround(load.span * last));
    const double span = static_cast<double>(node) / last;
    if (span != load.span) {
      report.add(assumed,
                 fmt::format("a point load at {:g} of the span acts on the next node, at {:g}",
                             load.span, span));
    }
    const std::pair<std::string, std::string> at{"Node", name_node(node)};
    write_load(fmt::format("force {}", i + 1), "Force", "Force", at, load.force, driver.dynamic,
               deck);
    write_load(fmt::format("moment {}", i + 1), "Moment", "Moment", at, load.moment, driver.dynamic,
               deck);
  }
  deck.close();
}

// The root circles the origin.
void write_rotation(const BeamDynDriver& driver, DeckWriter& deck) {
  deck.open("Functions");
  deck.open("turning", "Linear");
  deck.set("Duration", 1.0);
  deck.close();
  deck.close();
  deck.open("Constraints");
  deck.open("root", "Rigid Support");
  deck.set("Node", "blade/first");
  deck.set("Axis", driver.angular_velocity);
  deck.set("About", Vec3(Vec3::Zero()));
  deck.set("Angle", driver.angular_velocity.norm());
  deck.set("Angle Function", "turning");
  deck.close();
  deck.close();
  deck.open("Initial Conditions");
  deck.open("spin", "Velocity");
  deck.set("Node", blade);
  deck.set("Angular Velocity", driver.angular_velocity);
  deck.set("About", Vec3(Vec3::Zero()));
  deck.close();
  deck.close();
}

void write_clamp(DeckWriter& deck) {
  deck.open("Constraints");
  deck.open("root", "Rigid Support");
  deck.set("Node", "blade/first");
  deck.close();
  deck.close();
}

void write_dynamic(const BeamDynDriver& driver, DeckWriter& deck) {
  deck.open("Analyses");
  deck.open("motion", "Dynamic");
  if (driver.start != 0.0) deck.set("Start Time", driver.start);
  deck.set("End Time", driver.end);
  deck.set("Step", driver.step);
  deck.close();
  deck.close();
}

void report_mesh(Report& report) {
  report.add(assumed, fmt::format("mesh: {} director elements of order {}, {} nodes at equal arc "
                                  "lengths",
                                  mesh.elements, mesh.order, mesh.elements * mesh.order + 1));
}

}  // namespace

std::string write_deck(const BeamDyn& beam, Report& report) {
  report_conventions(report);
  report_mesh(report);
  report_blade("blade", beam, report);
  report.add(assumed,
             "the primary file has no loads: the blade is clamped at its root and lies "
             "horizontally, x downwards, under its own weight");
  DeckWriter deck(beam.title, heading("a blade under its own weight, x downwards, and its modes.",
                                      beam.path, beam));
  write_blade(beam, {}, deck);
  write_clamp(deck);
  deck.open("Loads");
  deck.open("weight", "Gravity");
  deck.set("Acceleration", Vec3(9.80665, 0.0, 0.0));
  deck.close();
  deck.close();
  write_static(true, deck);
  write_output(false, 1, deck);
  return deck.text();
}

std::string write_deck(const BeamDynDriver& driver, Report& report) {
  report_conventions(report);
  report_mesh(report);
  report_blade("blade", driver.beam, report);
  const std::string what = driver.dynamic
                               ? "a blade in motion, as a driver of BeamDyn asks for."
                               : "a blade in static equilibrium, as a driver of BeamDyn asks for.";
  DeckWriter deck(driver.title, heading(what, driver.path, driver.beam));
  write_blade(driver.beam, {driver.root, driver.axes}, deck);
  const bool turns = driver.dynamic && !driver.angular_velocity.isZero(0.0);
  if (turns) {
    write_rotation(driver, deck);
  } else {
    write_clamp(deck);
  }
  if (!driver.dynamic && !driver.angular_velocity.isZero(0.0)) {
    report.add(unknown, driver.path.string() +
                            ": RootVel is not zero, but the analysis is static: left out");
  }
  write_loads(driver, report, deck);
  int every = 1;
  if (driver.dynamic) {
    write_dynamic(driver, deck);
    constexpr double pictures = 100.0;
    every = std::max(1, static_cast<int>((driver.end - driver.start) / driver.step / pictures));
  } else {
    write_static(false, deck);
  }
  write_output(driver.dynamic, every, deck);
  return deck.text();
}

}  // namespace culm::openfast
