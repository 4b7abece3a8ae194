#include "shell_pairs.hpp"

#include <fmt/format.h>

namespace culm::joint {

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
  return pairs;
}

}  // namespace culm::joint
