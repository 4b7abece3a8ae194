/// Pairs of nodes of two shells that lie together.
#pragma once

#include <culm/model/build_context.hpp>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace culm::joint {

/// Parameters "First", "Second" and "Tolerance".
Schema pairs_schema(const std::string& type, const std::string& doc);

/// Where a node is looked for. @param side  0 for nodes of "First", 1 for those of "Second"
using PlaceOfNode = std::function<Vec3(int node, int side)>;

/// Each node of "Second" with the nearest of "First" within "Tolerance"; none, and issues, where
/// there is no such node.
std::vector<std::pair<int, int>> select_pairs(const Options& options, model::BuildContext& context,
                                              const PlaceOfNode& place);

}  // namespace culm::joint
