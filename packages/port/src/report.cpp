#include <culm/base/text.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace culm::port {
namespace {

// Where the axis bends more sharply, points of neighbouring cross-sections nearly meet.
constexpr double least_fibre = 0.2;

std::string plural(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string name_of(int structure, const model::Model& model) {
  if (structure < 0) return "nodes of no structure";
  return model.structures()[static_cast<std::size_t>(structure)].name;
}

// "point 7 at (1, 2, 3)"
std::string point_at(const Port& port, std::size_t point, const model::Model& model) {
  const Vec3 x = position(port.places()[point].marker, model.nodes().reference());
  return fmt::format("point {} at ({:.6g}, {:.6g}, {:.6g})", point, x[0], x[1], x[2]);
}

// Points of a kind: how many, and the first.
struct Kind {
  std::size_t count = 0, first = 0;
  void add(std::size_t point) {
    if (count++ == 0) first = point;
  }
};

// Nodes of a structure that no point moves with.
std::string uncovered(int number, const std::set<int>& moving, const model::Model& model) {
  if (number < 0) return {};
  const model::Structure& structure = model.structures()[static_cast<std::size_t>(number)];
  std::vector<int> still;
  for (const int node : structure.nodes) {
    if (!moving.contains(node)) still.push_back(node);
  }
  if (still.empty()) return {};
  return fmt::format(", {} of {} nodes of '{}' without points, '{}' the first", still.size(),
                     structure.nodes.size(), structure.name, model.node_name(still.front()));
}

// " towards (-1, 0, 0)", where all points that are away from their structures are on one side.
std::string side_of(const Port& port, const model::Model& model) {
  constexpr double one_side = 0.999;  // cosine
  constexpr double rounding = 1e-9;   // of coordinates [m]
  Vec3 sum = Vec3::Zero();
  std::vector<Vec3> sides;
  for (const Place& place : port.places()) {
    if (place.distance < rounding) continue;
    const Mat3 axes = directors(place.marker, model.nodes().reference());
    sides.push_back((axes * place.marker.offset).normalized());
    sum += sides.back();
  }
  const Vec3 mean = sum.normalized();
  for (const Vec3& side : sides) {
    if (!(side.dot(mean) > one_side)) return {};
  }
  if (sides.empty()) return {};
  const auto number = [](double x) { return std::round(1e3 * x) / 1e3 + 0.0; };  // without -0
  return fmt::format(" towards ({:g}, {:g}, {:g})", number(mean[0]), number(mean[1]),
                     number(mean[2]));
}

}  // namespace

std::string describe(const Port& port, const model::Model& model) {
  std::map<int, std::size_t> counts;
  std::set<int> moving;
  Kind beyond;
  double farthest = 0.0, past = 0.0;
  for (std::size_t p = 0; p < port.places().size(); ++p) {
    const Place& place = port.places()[p];
    ++counts[place.structure];
    farthest = std::max(farthest, place.distance);
    past = std::max(past, place.beyond);
    if (place.beyond > 0.0) beyond.add(p);
    for (std::size_t a = 0; a < place.marker.nodes.size(); ++a) {
      if (place.marker.weights[a] != 0.0) moving.insert(place.marker.nodes[a]);
    }
  }
  std::vector<std::string> on;
  for (const auto& [structure, count] : counts) {
    on.push_back(fmt::format("{} on '{}'", count, name_of(structure, model)));
  }
  std::string text = fmt::format("port '{}': {}, {}, up to {:.6g} m away{}", port.name(),
                                 plural(port.places().size(), "point"), join(on, ", "), farthest,
                                 side_of(port, model));
  if (beyond.count > 0) {
    text += fmt::format(", {} past ends or rims by up to {:.6g} m", beyond.count, past);
  }
  for (const auto& [structure, count] : counts) text += uncovered(structure, moving, model);
  return text;
}

std::vector<std::string> doubts(const Port& port, const model::Model& model) {
  Kind ambiguous, folded;
  for (std::size_t p = 0; p < port.places().size(); ++p) {
    if (port.places()[p].rival >= 0) ambiguous.add(p);
    if (port.places()[p].fibre < least_fibre) folded.add(p);
  }
  std::vector<std::string> texts;
  if (ambiguous.count > 0) {
    const Place& place = port.places()[ambiguous.first];
    const std::string chosen = name_of(place.structure, model), other = name_of(place.rival, model);
    texts.push_back(fmt::format(
        "port '{}': {} nearly as near to another place as to the one taken, the first of them {}: "
        "'{}' was taken, {} is about as near; name 'Structures' to choose",
        port.name(), plural(ambiguous.count, "point"), point_at(port, ambiguous.first, model),
        chosen, chosen == other ? "another part of it" : "'" + other + "'"));
  }
  if (folded.count > 0) {
    texts.push_back(
        fmt::format("port '{}': {} where the axis bends so sharply that cross-sections nearly "
                    "overlap, the first "
                    "of them {}: fibres have {:.2g} of the length of the axis there",
                    port.name(), plural(folded.count, "point"), point_at(port, folded.first, model),
                    port.places()[folded.first].fibre));
  }
  return texts;
}

}  // namespace culm::port
