#include "sea_lists.hpp"

#include "headings.hpp"

#include <cmath>

namespace culm::openfast {

namespace {

constexpr const char* pole = "pole";

Vec3 along(double heading) { return {std::cos(heading), std::sin(heading), 0.0}; }

void write_current(const SeaState& sea, DeckWriter& deck) {
  if (sea.current.empty()) return;
  deck.open("Current", sea.current);
  if (sea.current == "Table") {
    deck.set("Depths", sea.current_depths);
    deck.set("Speeds", sea.current_speeds);
  } else {
    deck.set("Speed", sea.current_speed);
  }
  deck.set("Direction", along(sea.current_heading));
  deck.close();
}

}  // namespace

void write_sea(const SeaState& sea, DeckWriter& deck) {
  const bool is_regular = sea.kind == SeaState::Kind::regular;
  const bool is_still = sea.kind == SeaState::Kind::still;
  deck.open(sea_name, is_still ? "Still Water" : is_regular ? "Regular Waves" : "Irregular Waves");
  deck.set("Density", sea.density);
  deck.set("Depth", sea.depth);
  deck.set("Gravity", sea.gravity);
  if (sea.level != 0.0) deck.set("Level", sea.level);
  if (!is_still) {
    deck.set("Direction", along(sea.heading));
    deck.set("Height", sea.height);
    deck.set("Period", sea.period);
    deck.set("Stretching", sea.stretching);
  }
  if (!is_still && sea.rise > 0.0) deck.set("Rise", sea.rise);
  if (is_regular && sea.phase != 0.0) deck.set("Phase", -sea.phase);
  if (sea.kind == SeaState::Kind::irregular) {
    if (sea.peak) deck.set("Peak", *sea.peak);
    if (sea.lowest > 0.0) deck.set("Lowest", sea.lowest);
    if (sea.highest > 0.0) deck.set("Highest", sea.highest);
    if (sea.spreading) {
      deck.set("Spreading", *sea.spreading);
      deck.set("Spreading Range", sea.spreading_range);
    }
    deck.set("Seed", sea.seed);
  }
  write_current(sea, deck);
  deck.close();
}

void write_flows(const SeaState& sea, DeckWriter& deck) {
  deck.open("Flows");
  write_sea(sea, deck);
  deck.close();
}

void write_held_body(const std::string& name, const std::string& constraint, DeckWriter& deck) {
  deck.open("Structures");
  deck.open(name, "Rigid Body");
  deck.set("Position", Vec3(Vec3::Zero()));
  deck.set("Mass", 1.0);
  deck.set("Inertia", Vec3(Vec3::Ones()));
  deck.close();
  deck.close();
  deck.open("Constraints");
  deck.open(constraint, "Rigid Support");
  deck.set("Node", name);
  deck.close();
  deck.close();
}

std::string write_deck(const SeaState& sea, Report& report) {
  DeckWriter deck(sea.title, {"Shows: a sea at the origin.",
                              "Imported from " + sea.path.filename().string() + " of OpenFAST.",
                              "z is up, 0 at mean sea level. SI units."});
  write_held_body(pole, "held", deck);
  write_flows(sea, deck);
  deck.open("Loads");
  deck.open("water on the pole", "Morison");
  deck.set("Node", pole);
  deck.set("From", Vec3(0.0, 0.0, sea.level - sea.depth));
  deck.set("To", Vec3(0.0, 0.0, sea.level + 2.0 * sea.height + 1.0));
  deck.set("Flow", sea_name);
  deck.set("Diameter", 1e-3);
  deck.set("Dry Ends", std::vector<std::string>{"first"});
  deck.close();
  deck.close();
  deck.open("Analyses");
  deck.open("sea", "Dynamic");
  deck.set("Start Time", 0.0);
  deck.set("End Time", 60.0);
  deck.set("Step", 0.25);
  deck.close();
  deck.close();
  deck.open("Output");
  deck.set("Every", 10);
  deck.open("History");
  deck.open("sea", "Waves");
  deck.set("Load", "water on the pole");
  deck.set("Point", Vec3(0.0, 0.0, sea.level));
  deck.close();
  deck.close();
  deck.close();
  report.add(assumed,
             "a pole of 1 mm stands in the sea so that its history can be seen; 60 s of it");
  return deck.text();
}

}  // namespace culm::openfast
