#include <culm/base/error.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/imperfection.hpp>

#include <fmt/format.h>

namespace culm::model {

void Imperfection::add(const std::string& structure, const std::vector<Vec6>& motions,
                       const Where& where) {
  Entry& entry = entries_[structure];
  entry.where = where;
  if (entry.motions.empty()) entry.motions.resize(motions.size(), Vec6::Zero());
  if (entry.motions.size() != motions.size()) {
    throw InputError(where, fmt::format("shapes for '{}' have {} and {} nodes", structure,
                                        entry.motions.size(), motions.size()));
  }
  for (std::size_t i = 0; i < motions.size(); ++i) entry.motions[i] += motions[i];
}

const std::vector<Vec6>& Imperfection::of(const std::string& structure, std::size_t nodes) const {
  static const std::vector<Vec6> none;
  const auto found = entries_.find(structure);
  if (found == entries_.end()) return none;
  if (found->second.motions.size() != nodes) {
    throw InputError(found->second.where,
                     fmt::format("the shape has {} nodes for '{}', which has {} here",
                                 found->second.motions.size(), structure, nodes));
  }
  return found->second.motions;
}

NodeSlots Imperfection::moved(const std::string& structure, const NodeSlots& node) const {
  const std::vector<Vec6>& motions = of(structure, 1);
  if (motions.empty()) return node;
  NodeSlots result = node;
  result.col(0) += motions.front().head<3>();
  result.rightCols<3>() = exp_rotation(motions.front().tail<3>()) * node.rightCols<3>();
  return result;
}

}  // namespace culm::model
