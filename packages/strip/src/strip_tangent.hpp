/// The tangent of a station of a strip.
#pragma once

#include "strip_evaluation.hpp"

#include <array>
#include <cstddef>

namespace culm::strip {

// dr / du = -(P_theta^T T) dF/dX (P_next^T T)^T,   X the vectors of the section at the end
template <class Space>
void StripLoad::add_tangent(std::size_t i, const Evaluation& found, const model::State& state,
                            double theta, bool turns, model::Target& target) {
  constexpr int W = Space::width;
  const Station& station = stations_[static_cast<std::size_t>(placement().items[i])];
  const std::size_t n = station.point.nodes.size();
  const StationNodes motion(nodes_, station.point.nodes, state, theta);
  std::array<Mat<4, 3>, max_nodes> T;
  for (std::size_t a = 0; a < n; ++a) T[a] = factors(station, a);
  const RowMat<9, 9> derivative = -found.derivative;
  for (std::size_t a = 0; a < n; ++a) {
    RowMat<W, 9> by_vectors;
    reduce_vectors<Space>(T[a], motion.arms_mid[a], derivative, by_vectors);
    const RowMat<9, W> transposed = by_vectors.transpose();
    for (std::size_t b = 0; b < n; ++b) {
      Mat<W, W> columns;
      reduce_vectors<Space>(T[b], motion.arms_next[b], transposed, columns);
      RowMat<W, W> block = columns.transpose();
      if (a == b && turns) {
        Space::add_turning(Mat<3, 4>(-found.forces * T[a].transpose()), motion.arms_next[a], theta,
                           block);
      }
      placement().scatter.add_tangent(i, static_cast<int>(a), static_cast<int>(b), block, target);
    }
  }
}

}  // namespace culm::strip
