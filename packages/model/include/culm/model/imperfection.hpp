/// Deviations of the stress-free geometry.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/math/types.hpp>
#include <culm/model/node_table.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::model {

/// Motions of nodes that structures are built with, so that their reference, free of stress, is the
/// imperfect one. Several add up.
class Imperfection {
 public:
  /// @param motions  per node of the structure, in its order: displacement [m] and rotation vector
  ///                 [rad], of a shell node the change of its director
  /// @param where    in the deck, for messages
  void add(const std::string& structure, const std::vector<Vec6>& motions, const Where& where);

  /// Motions of all nodes of a structure; empty if it is perfect.
  /// @param nodes  how many it has. Throws InputError if the imperfection was made for another
  /// number
  const std::vector<Vec6>& of(const std::string& structure, std::size_t nodes) const;
  /// The only node of a structure, moved and turned; with place and triad.
  NodeSlots moved(const std::string& structure, const NodeSlots& node) const;

 private:
  struct Entry {
    std::vector<Vec6> motions;
    Where where;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace culm::model
