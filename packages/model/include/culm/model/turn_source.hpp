/// Elements that are good for moderate turns of their nodes against each other only.
#pragma once

#include <culm/mechanics/node.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/state.hpp>

#include <concepts>
#include <optional>

namespace culm::model {

/// Which turns an element is sensitive to.
struct TurnKind {
  int order = 1;          ///< of the law, see TurnLaw
  bool of_frame = false;  ///< turns against a frame, no matter how many elements lie between
};

/// An element with such a limit: `turn_kind`, and the cosine of the largest turn of its intervals,
/// of which there are as many as its order. @param at  slots of each of its nodes
template <class E>
concept HasTurn = requires(const E& e, NodeSlots (*const& at)(int)) {
  { E::turn_kind } -> std::convertible_to<TurnKind>;
  { e.least_cosine(at) }
  noexcept->std::same_as<double>;
};

/// Tells how far its items are turned.
class TurnSource {
 public:
  virtual ~TurnSource() = default;
  /// Nothing where items are as good at any turn.
  virtual std::optional<TurnKind> turn_kind() const = 0;
  /// Largest turn between the ends of an owned item, as if all its intervals were turned as the one
  /// that is turned most [rad]; 0 without items.
  virtual double largest_turn(const Coordinates& q) const = 0;
  /// The first owned item turned by at least so much; -1 if there is none.
  virtual int first_turned(const Coordinates& q, double turn) const = 0;
  /// Whether this rank counts the item; exactly one does.
  virtual bool owns(int item) const = 0;
  /// Turn of an item that is here [rad].
  virtual double turn_of(int item, const Coordinates& q) const = 0;
};

/// Cosine of the angle by which the triads of two nodes are turned against each other; the slots
/// of a node are x, d1, d2, d3.
inline double cosine_between(const auto& one, const auto& other) {
  return 0.5 *
         (one.template rightCols<3>().cwiseProduct(other.template rightCols<3>()).sum() - 1.0);
}

}  // namespace culm::model
