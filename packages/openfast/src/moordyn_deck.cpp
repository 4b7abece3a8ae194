#include "moordyn_deck.hpp"

#include <culm/base/error.hpp>

#include "floater.hpp"
#include "headings.hpp"
#include "sea_lists.hpp"

#include <fmt/format.h>

#include <vector>

namespace culm::openfast {

namespace {

// The fixed end and the one on the vessel; null where there are not both.
std::array<const MooringPoint*, 2> ends_of(const MoorDyn& moorings, const MooringLine& line) {
  const MooringPoint *a = &moorings.points[line.points[0]], *b = &moorings.points[line.points[1]];
  if (a->kind == MooringPoint::Kind::vessel) std::swap(a, b);
  const bool fits = a->kind == MooringPoint::Kind::fixed && b->kind == MooringPoint::Kind::vessel;
  return fits ? std::array{a, b} : std::array<const MooringPoint*, 2>{};
}

}  // namespace

bool moors_the_vessel(const MoorDyn& moorings, const MooringLine& line) {
  return ends_of(moorings, line)[0] != nullptr;
}

std::vector<std::string> write_lines(const MoorDyn& moorings, const std::string& body,
                                     DeckWriter& deck, Report& report) {
  std::vector<std::string> names;
  for (const MooringLine& line : moorings.lines) {
    const LineType& type = moorings.types[line.type];
    const auto [anchor, fairlead] = ends_of(moorings, line);
    if (anchor == nullptr) {
      report.add(missing,
                 fmt::format("line {}: does not lead from a fixed point to the vessel, and "
                             "is not in the deck",
                             line.id));
      continue;
    }
    const double weight = wet_weight(moorings, type);
    if (!(weight > 0.0)) {
      throw InputError(
          {moorings.path.string(), 0, "line type " + type.name},
          fmt::format("floats, with a weight of {:g} N/m in water; must sink", weight));
    }
    names.push_back(fmt::format("line {}", line.id));
    deck.open(names.back(), "Catenary");
    deck.set("Node", body);
    deck.set("Offset", fairlead->place);
    deck.set("Anchor", anchor->place);
    deck.set("Length", line.length);
    deck.set("EA", type.stiffness);
    deck.set("Weight", weight);
    if (type.friction > 0.0) deck.set("Friction", type.friction);
    deck.close();
    report.add(checked, fmt::format("{}: {:.10g} N/m in water, {:.10g} kg", names.back(), weight,
                                    type.mass * line.length));
  }
  report.add(
      assumed,
      "lines are at rest at each moment, on a seabed at the depth of their anchors, with the "
      "friction CB of MAP++ only: no inertia, no drag, no damping");
  return names;
}

std::string write_deck(const MoorDyn& moorings, Report& report) {
  DeckWriter deck(moorings.title,
                  {"Shows: mooring lines on a platform that does not move.",
                   "Imported from " + moorings.path.filename().string() + " of OpenFAST.",
                   "z is up, 0 at mean sea level, the platform's reference point at the origin. SI "
                   "units."});
  write_held_body(platform_name, "held", deck);
  deck.open("Loads");
  const std::vector<std::string> names = write_lines(moorings, platform_name, deck, report);
  deck.close();
  if (names.empty()) {
    throw InputError({moorings.path.string(), 0, "lines"},
                     "none leads from a fixed point to the vessel: there is nothing to import");
  }
  deck.open("Analyses");
  deck.open("rest", "Static");
  deck.set("Steps", 1);
  deck.close();
  deck.close();
  deck.open("Output");
  deck.open("History");
  for (const std::string& name : names) {
    deck.open(name, "Line");
    deck.set("Load", name);
    deck.close();
  }
  deck.open("platform", "Reaction");
  deck.set("Node", platform_name);
  deck.close();
  deck.close();
  deck.close();
  report.add(assumed, "the platform is held at the origin");
  return deck.text();
}

}  // namespace culm::openfast
