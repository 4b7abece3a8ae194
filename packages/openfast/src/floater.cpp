#include "floater.hpp"

#include "headings.hpp"
#include "hydrodyn_deck.hpp"
#include "moordyn_deck.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace culm::openfast {

namespace {

std::string line_name(const MooringLine& line) { return fmt::format("line {}", line.id); }

}  // namespace

void write_held_freedoms(const ElastoDyn& turbine, DeckWriter& deck) {
  constexpr const char* names[] = {"no surge", "no sway",  "no heave",
                                   "no roll",  "no pitch", "no yaw"};
  for (int i = 0; i < 6; ++i) {
    if (turbine.platform.free[static_cast<std::size_t>(i)]) continue;
    const bool turns = i >= 3;
    deck.open(names[i], turns ? "Rotation" : "Simple Support");
    deck.set("Node", platform_name);
    deck.set(turns ? "Axis" : "Direction", Vec3(Vec3::Unit(i % 3)));
    deck.close();
  }
}

void write_ballast(const ElastoDyn& turbine, DeckWriter& deck, Report& report) {
  const Ballast ballast = ballast_of(turbine.floater->water);
  if (!(ballast.mass > 0.0)) return;
  deck.open("ballast", "Rigid Body");
  deck.set("Position", turbine.platform.reference);
  deck.set("Mass", ballast.mass);
  deck.set("Centre", ballast.centre);
  const Mat3& J = ballast.inertia;
  deck.set("Inertia", std::vector<double>{J(0, 0), J(1, 1), J(2, 2), J(1, 2), J(0, 2), J(0, 1)});
  deck.close();
  report.add(masses,
             fmt::format("what fills the members: {:.6g} kg, centre at z = {:.5g} m, at rest "
                         "in them",
                         ballast.mass, ballast.centre.z()));
}

void write_ballast_support(const ElastoDyn& turbine, DeckWriter& deck) {
  if (!(ballast_of(turbine.floater->water).mass > 0.0)) return;
  deck.open("ballast", "Rigid Connection");
  deck.set("Node", "ballast");
  deck.set("Master", platform_name);
  deck.close();
}

void write_floater_loads(const ElastoDyn& turbine, const std::filesystem::path& folder,
                         DeckWriter& deck, Report& report) {
  const Floater& floater = *turbine.floater;
  write_hull(floater.water, platform_name, folder, deck, report);
  write_members(floater.water, platform_name, true, deck, report);
  if (floater.moorings) {
    write_lines(*floater.moorings, platform_name, deck, report);
  } else {
    report.add(missing,
               "mooring lines: nothing moors the platform in surge, sway and yaw but what "
               "HydroDyn's file adds");
  }
  report.add(
      assumed,
      "the platform floats about its place in the files; weight and modes are those in still "
      "water, and waves grow within one of their periods");
}

void write_floater_history(const ElastoDyn& turbine, DeckWriter& deck) {
  for (const char* type : {"Displacement", "Rotation"}) {
    deck.open(std::string("platform ") + (type[0] == 'D' ? "motion" : "turn"), type);
    deck.set("Node", platform_name);
    deck.close();
  }
  if (!turbine.floater->moorings) return;
  for (const MooringLine& line : turbine.floater->moorings->lines) {
    if (!moors_the_vessel(*turbine.floater->moorings, line)) continue;
    deck.open(line_name(line), "Line");
    deck.set("Load", line_name(line));
    deck.close();
  }
}

}  // namespace culm::openfast
