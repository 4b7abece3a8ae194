#include "shell_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace culm::joint {
namespace {

// Nodes of a side that belong to one element, two by two.
std::set<std::pair<int, int>> neighbours(const std::vector<int>& side, const model::Model& model) {
  const std::set<int> members(side.begin(), side.end());
  std::set<const model::Structure*> structures;
  for (const int node : side) structures.insert(model.structure_of(node));
  structures.erase(nullptr);
  std::set<std::pair<int, int>> pairs;
  for (const model::Structure* structure : structures) {
    for (const model::Cell& cell : structure->cells) {
      for (const int a : cell.nodes) {
        for (const int b : cell.nodes) {
          if (a < b && members.contains(a) && members.contains(b)) pairs.emplace(a, b);
        }
      }
    }
  }
  return pairs;
}

// Whether a place is where two others are seen in opposite directions; on the arc of a circle
// between two places up to 50 degrees apart, too.
bool lies_between(const Vec3& at, const Vec3& one, const Vec3& other) {
  constexpr double opposite = -0.9;
  const Vec3 a = one - at;
  const Vec3 b = other - at;
  return a.dot(b) < opposite * a.norm() * b.norm();
}

// Sides whose meshes do not fit would part where nodes of the first have no partner.
void refuse_gaps(const std::vector<int>& first, const std::vector<int>& second,
                 const std::vector<std::pair<int, int>>& pairs, const PlaceOfNode& place,
                 const Options& options, model::BuildContext& context) {
  std::set<int> free(first.begin(), first.end());
  for (const auto& [joined, partner] : pairs) free.erase(joined);
  if (free.empty()) return;
  const auto sides = neighbours(second, context.model);
  std::vector<int> gaps;
  std::ranges::copy_if(free, std::back_inserter(gaps), [&](int node) {
    const Vec3 at = place(node, 0);
    return std::ranges::any_of(sides, [&](const auto& side) {
      return lies_between(at, place(side.first, 1), place(side.second, 1));
    });
  });
  if (gaps.empty()) return;
  context.issues.add(
      options.where("First"),
      fmt::format("{} of {} nodes, '{}' the first of them, lie between nodes of Second and have no "
                  "partner there, so that the shells would part; take meshes whose nodes meet",
                  gaps.size(), first.size(), context.model.node_name(gaps.front())));
}

}  // namespace

Schema pairs_schema(const std::string& type, const std::string& doc) {
  Schema schema(type, doc);
  schema.add(model::node_field("First", "Nodes of one side."))
      .add(model::node_field("Second", "Nodes of the other; each is joined to the nearest first."))
      .add(number("Tolerance", "m",
                  "How far the places of a pair may be apart; 1e-4 of the size of the model if "
                  "absent.")
               .positive()
               .optional());
  return schema;
}

std::vector<std::pair<int, int>> select_pairs(const Options& options, model::BuildContext& context,
                                              const PlaceOfNode& place) {
  const std::vector<int> first = model::select_nodes(options, "First", context);
  const std::vector<int> second = model::select_nodes(options, "Second", context);
  const double tolerance =
      options.has("Tolerance") ? options.number("Tolerance") : 1e-4 * context.model.length();
  std::vector<std::pair<int, int>> pairs;
  if (first.empty()) return pairs;
  for (int node : second) {
    const Vec3 at = place(node, 1);
    int nearest = first.front();
    double distance = (place(nearest, 0) - at).norm();
    for (int other : first) {
      const double d = (place(other, 0) - at).norm();
      if (d < distance) {
        nearest = other;
        distance = d;
      }
    }
    const std::string name = context.model.node_name(node);
    if (nearest == node) {
      context.issues.add(options.where("Second"), "node '" + name + "' is one of First as well");
      return {};
    }
    if (distance > tolerance) {
      context.issues.add(options.where("Second"),
                         fmt::format("node '{}' is {:.3g} m from the nearest of First, '{}'; the "
                                     "tolerance is {:.3g} m",
                                     name, distance, context.model.node_name(nearest), tolerance));
      return {};
    }
    pairs.emplace_back(nearest, node);
  }
  refuse_gaps(first, second, pairs, place, options, context);
  return pairs;
}

}  // namespace culm::joint
