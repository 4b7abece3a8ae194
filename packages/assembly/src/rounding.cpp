#include <culm/assembly/rounding.hpp>
#include <culm/math/fetch.hpp>

#include "block_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::assembly {
namespace {

// Roundings between a coordinate and a row: of the coordinate, of the strain, of the stress and of
// their products.
constexpr double roundings = 4.0;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// That are judged before those that memory is asked for.
constexpr int rows_ahead = 36;

// A residual so far above its bound needs no exact number.
constexpr double hopeless = 1e3;

// Largest sizes of the translations of a node; where supports take some of them away, what is left
// feels the rounding of all.
Vec3 position_size(const model::BlockShape& shape, const Vec3& prev, const Vec3& next) {
  const Vec3 size = prev.cwiseAbs().cwiseMax(next.cwiseAbs());
  return shape.full() ? size : Vec3(Vec3::Constant(size.maxCoeff()));
}

// How far the farthest node that follows it is from each node; empty where none does. The place of
// a follower is found from that of its master, and rounded as it is.
std::vector<double> levers_of(const model::NodeTable& nodes) {
  std::vector<double> levers;
  const auto place = [&](int node) {
    return model::NodeTable::slots(nodes.reference(), node).col(0);
  };
  for (int node = 0; node < nodes.size(); ++node) {
    if (!nodes.is_slave(node)) continue;
    levers.resize(index(nodes.size()), 0.0);
    double& lever = levers[index(nodes.master(node))];
    lever = std::max(lever, (place(node) - place(nodes.master(node))).norm());
  }
  return levers;
}

// Sizes of the unknowns of the local columns, in proportion to which they are rounded.
std::vector<double> unknown_sizes(const System& system, const EvaluatedPoint& point) {
  // directors are of unit length
  std::vector<double> sizes(system.layout().columns().size(), 1.0);
  const std::vector<double> levers = levers_of(system.model().nodes());
  for (const Layout::LocalBlock& local : system.layout().local_blocks()) {
    const model::Block& block = system.model().unknowns().block(local.block);
    const bool is_node = block.kind == model::BlockKind::node;
    Vec3 position = Vec3::Zero();
    if (is_node) {
      position = position_size(block.shape, model::NodeTable::slots(point.prev, block.owner).col(0),
                               model::NodeTable::slots(point.next, block.owner).col(0));
      if (!levers.empty()) position.array() += levers[index(block.owner)];
    }
    for (int i = 0; i < (is_node ? 3 : block.shape.width); ++i) {
      const int at = block.shape.position[index(i)];
      if (at < 0) continue;
      double& size = sizes[index(local.first_column + at)];
      const std::size_t value = index(block.first_value + i);
      if (is_node) {
        size = position[i];
      } else if (block.kind == model::BlockKind::multipliers) {
        size = std::abs(point.multipliers[value]) / system.multiplier_scale();
      } else {
        const auto& unknowns = system.model().own_blocks()[index(block.owner)].unknowns;
        size =
            std::abs(point.own[value]) / own_scale(unknowns[index(i)], system.multiplier_scale());
      }
    }
  }
  return sizes;
}

}  // namespace

RoundingCheck check_rounding(const System& system, const EvaluatedPoint& point, double limit,
                             double force_scale) {
  const std::vector<double> sizes = unknown_sizes(system, point);
  const auto residual = system.residual().values();
  const Matrix& matrix = *system.matrix();
  const auto values = matrix.values();
  const auto row_begin = matrix.row_begin();
  const auto column_of = matrix.column_of();
  const auto first_column = system.first_columns();
  const int num_rows = system.layout().num_node_rows();
  double share = 0.0;
  double largest = 0.0;
  int largest_row = 0;
  const auto judge = [&](int row) {
    const double found = std::abs(residual[index(row)]);
    if (found <= limit || share > hopeless) return;
    const int later = std::min(row + rows_ahead, num_rows - 1);
    fetch(values.data() + row_begin[index(later)], sizeof(double));
    if (found > largest) {
      largest = found;
      largest_row = row;
    }
    const std::size_t first = row_begin[index(row)];
    const std::size_t last = row_begin[index(row) + 1];
    // as many forces meet in a row as it has entries, or fewer
    const double terms = static_cast<double>(last - first) * force_scale;
    // from here on the share cannot exceed the largest one so far
    const double enough = (found / (epsilon * share) - terms) / roundings;
    double sum = 0.0;
    const auto reaches_enough = [&](const auto& size_of) {
      for (auto k = first; k < last && sum < enough; ++k) sum += std::abs(values[k]) * size_of(k);
      return sum >= enough;
    };
    const int column = first_column[index(row)];
    const bool is_small =
        column < 0 ? reaches_enough([&](auto k) { return sizes[index(column_of[k])]; })
                   : reaches_enough([&](auto k) { return sizes[index(column) + (k - first)]; });
    if (is_small) return;
    share = std::max(share, found / (epsilon * (roundings * sum + terms)));
  };
  // where the largest one is hopeless, as before the last iterations, no other need be judged
  int worst_row = -1;
  double worst_found = -1.0;
  for (int row = 0; row < num_rows; ++row) {
    const double found = std::abs(residual[index(row)]);
    if (!(found > worst_found)) continue;
    worst_found = found;
    worst_row = row;
  }
  if (worst_row >= 0) judge(worst_row);
  for (int row = 0; row < num_rows && share <= hopeless; ++row) judge(row);
  const parallel::Comm& comm = system.comm();
  double worst[2] = {share, largest};
  comm.max(worst);
  const bool is_here = largest > 0.0 && largest == worst[1];
  const auto global = system.layout().rows().global(index(largest_row));
  return {worst[0], comm.max(is_here ? static_cast<int>(global) : -1)};
}

double rounding_energy(const System& system, const EvaluatedPoint& point) {
  std::vector<double> sizes = unknown_sizes(system, point);
  const auto each_block = [&](auto action) {
    for (const Layout::LocalBlock& local : system.layout().local_blocks()) {
      const model::Block& block = system.model().unknowns().block(local.block);
      action(local, block, block.kind == model::BlockKind::node);
    }
  };
  each_block([&](const Layout::LocalBlock& local, const model::Block& block, bool is_node) {
    if (is_node) return;
    std::fill_n(sizes.begin() + local.first_column, block.shape.active, 0.0);
  });
  const Matrix& matrix = *system.matrix();
  const auto values = matrix.values();
  const auto row_begin = matrix.row_begin();
  const auto column_of = matrix.column_of();
  double sum = 0.0;
  each_block([&](const Layout::LocalBlock& local, const model::Block& block, bool is_node) {
    if (!is_node || !local.owned) return;
    for (int row = local.first_column; row < local.first_column + block.shape.active; ++row) {
      for (auto k = row_begin[index(row)]; k < row_begin[index(row) + 1]; ++k) {
        sum += sizes[index(row)] * std::abs(values[k]) * sizes[index(column_of[k])];
      }
    }
  });
  return roundings * epsilon * epsilon * system.comm().sum(sum);
}

}  // namespace culm::assembly
