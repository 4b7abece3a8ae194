/// How far elements are turned, and what their interpolation makes of it.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/model/turn_law.hpp>
#include <culm/model/turn_source.hpp>

#include <string>
#include <vector>

namespace culm::analysis {

/// An element whose nodes are turned against each other.
struct ElementTurn {
  double share = 0.0;      ///< of the turn that its law is good for; above 1 it is worth a warning
  double turn = 0.0;       ///< [rad], see TurnSource
  double reference = 0.0;  ///< the same without load [rad]
  model::TurnKind kind;
  std::string structure;
  int element = -1;   ///< its number in the deck
  std::string place;  ///< when that was, as words of a sentence

  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

  model::TurnErrors errors() const;
  /// Whether it has come near to its own greatest moment, which may end what a load can do.
  bool may_be_the_limit() const;
  /// What it is turned by: "element 3 of 'beam', of order 1, is turned by 0.3 rad between its ends"
  std::string name() const;
  /// The errors that come of it.
  std::string consequence() const;
  /// Whether the element is turned so far that its moment falls: then results mean nothing.
  bool is_meaningless() const;
  /// What would help, to follow "take".
  std::string cure() const;
  /// All of it in a sentence.
  std::string warning() const;
};

/// Watches the elements of a system. One pass over them for a configuration.
class ElementTurns {
 public:
  /// Error of the strain energy from which a turn is worth a warning: 0.2 rad of order 1, 1.2 rad
  /// of order 2, 1.6 rad of order 3.
  static constexpr double worth_a_warning = 0.04;

  explicit ElementTurns(const assembly::System& system);

  /// Largest share of all elements (see ElementTurn), 0 if none has a law. Collective.
  double largest_share(const model::Coordinates& q) const;
  /// The element with that share: of those that differ by rounding only the first one, whatever the
  /// number of ranks. Collective. @pre share = largest_share(q) > 0
  ElementTurn find(const model::Coordinates& q, double share) const;

 private:
  // elements of one kind
  struct Source {
    const model::TurnSource* turns;
    double good_for;  // [rad]
    int items;        // how many it has
  };

  const assembly::System& system_;
  std::vector<Source> sources_;
};

}  // namespace culm::analysis
