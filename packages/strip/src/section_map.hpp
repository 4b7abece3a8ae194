/// The map between the slots of nodes and the vectors of a section, which are linear in them.
#pragma once

#include <culm/load/slot_kernel.hpp>
#include <culm/strip/strip_load.hpp>

#include <cstddef>

namespace culm::strip {

/// Vectors of a section: axis, chord, normal.
using Columns = Mat<3, 3>;

/// The nodes of a station in a step.
using StationNodes = model::ItemMotion<StripLoad::max_nodes>;

/// What the slots of node a do for the vectors of a section.
inline Mat<4, 3> factors(const Station& station, std::size_t a) {
  const double weight = station.point.weights[a];
  Mat<4, 3> T;
  T.col(0) << weight, weight * station.point.offset;
  T.col(1) << 0.0, weight * station.along;
  T.col(2) << 0.0, weight * station.across;
  return T;
}

/// The same for their coordinates, one after another.
inline Mat<12, 9> slots_of_vectors(const Mat<4, 3>& T) {
  Mat<12, 9> result = Mat<12, 9>::Zero();
  for (int s = 0; s < 4; ++s) {
    for (int p = 0; p < 3; ++p) {
      result.block<3, 3>(3 * s, 3 * p).diagonal().setConstant(T(s, p));
    }
  }
  return result;
}

/// P^T T rows: what rows of the vectors of a section, one after another, are to the unknowns of a
/// node. Where directors turn with it, their arms make those of the vectors, which are fewer.
template <class Space, class Rows, class Reduced>
void reduce_vectors(const Mat<4, 3>& T, const model::Arms<4>& arms, const Rows& rows,
                    Reduced& reduced) {
  if (Space::form == model::Form::null_space && arms.turns) {
    const model::Arms<3> of_vectors{arms.slots.lazyProduct(T), true};
    model::NullSpace::reduce_rows(rows, of_vectors, reduced.template topRows<6>());
    reduced.template topRows<3>() *= T(0, 0);  // the axis alone moves with the node
    return;
  }
  const Mat<12, Rows::ColsAtCompileTime> slots = slots_of_vectors(T).lazyProduct(rows);
  Space::reduce_rows(slots, arms, reduced);
}

/// The vectors of a section from the slots of its nodes, by number of the node and place in the
/// list.
template <class Slots>
Columns vectors_of(const Station& station, const Slots& slots) {
  Columns result = Columns::Zero();
  for (std::size_t a = 0; a < station.point.nodes.size(); ++a) {
    result += slots(station.point.nodes[a], a) * factors(station, a);
  }
  return result;
}

inline Columns vectors_of(const Station& station, const model::Coordinates& q) {
  return vectors_of(station, [&](int node, std::size_t) -> model::NodeSlots {
    return model::NodeTable::slots(q, node);
  });
}

}  // namespace culm::strip
