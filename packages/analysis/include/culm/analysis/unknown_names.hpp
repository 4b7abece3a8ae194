/// What a global unknown is, in the words of the deck.
#pragma once

#include <culm/assembly/system.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::analysis {

/// Name of a component of a motion: "x" to "rotation z".
const char* direction_name(int i);
/// Type and name of a constraint.
std::string quoted_name(const model::Constraint& constraint);

/// Names unknowns and finds the large entries of vectors.
class UnknownNames {
 public:
  explicit UnknownNames(const assembly::System& system) : system_(system) {}

  /// One unknown with its share in a residual or in a direction.
  struct Entry {
    std::string name;
    double value = 0.0;
  };
  /// Which unknown of its block a number means: of 12 coordinates, 6 motions or the multipliers.
  struct Place {
    model::Block block;
    int written = 0;
  };

  Place place_of(int unknown) const;
  std::string name_of(int unknown) const;
  /// The largest entries, largest first, on rank 0; collective.
  std::vector<Entry> largest_entries(const assembly::Vector& vector, std::size_t count) const;
  /// The entries of at least `least` of all ranks by unknown, on rank 0; collective.
  std::map<int, double> entries(const assembly::Vector& vector, double least) const;

 private:
  const assembly::System& system_;
};

}  // namespace culm::analysis
