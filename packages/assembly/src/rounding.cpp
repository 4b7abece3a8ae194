#include <culm/assembly/rounding.hpp>
#include <culm/math/fetch.hpp>

#include "block_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

namespace culm::assembly {
namespace {

// Roundings between a coordinate and a row: of the coordinate, of the strain, of the stress and of
// their products.
constexpr double roundings = 4.0;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Blocks whose sizes are found, and rows that are judged, before those that memory is asked for.
constexpr std::size_t blocks_ahead = 16;
constexpr int rows_ahead = 72;

// Largest sizes of the translations of a node; where supports take some of them away, what is left
// feels the rounding of all.
Vec3 position_size(const model::BlockShape& shape, const Vec3& prev, const Vec3& next) {
  const Vec3 size = prev.cwiseAbs().cwiseMax(next.cwiseAbs());
  return shape.full() ? size : Vec3(Vec3::Constant(size.maxCoeff()));
}

// Sizes of unknowns, in proportion to which they are rounded.
class UnknownSizes {
 public:
  UnknownSizes(const System& system, const EvaluatedPoint& point)
      : system_(system), point_(point) {}

  // Of all local columns, each of which is of a block.
  std::unique_ptr<double[]> all() const {
    auto sizes = std::make_unique_for_overwrite<double[]>(system_.layout().columns().size());
    const auto& blocks = system_.layout().local_blocks();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const int later = blocks[std::min(b + blocks_ahead, blocks.size() - 1)].block;
      if (later < system_.model().nodes().size()) {  // blocks of nodes come first
        const int place = model::NodeTable::offset(later);
        fetch(point_.prev.data() + place, sizeof(Vec3));
        fetch(point_.next.data() + place, sizeof(Vec3));
      }
      put(blocks[b], sizes.get() + blocks[b].first_column);
    }
    return sizes;
  }

  // Of one local column; quick for one after another.
  double of(int column) {
    if (column < first_ || column >= end_) find_block_of(column);
    return sizes_[index(column - first_)];
  }

 private:
  void find_block_of(int column) {
    const auto& blocks = system_.layout().local_blocks();
    // blocks without unknowns share the first column of their successor
    const auto after =
        std::ranges::upper_bound(blocks, column, {}, &Layout::LocalBlock::first_column);
    const Layout::LocalBlock& local = *std::prev(after);
    first_ = local.first_column;
    end_ = first_ + system_.model().unknowns().block(local.block).shape.active;
    put(local, sizes_.data());
  }

  void put(const Layout::LocalBlock& local, double* sizes) const {
    const model::Block block = system_.model().unknowns().block(local.block);
    std::fill_n(sizes, block.shape.active, 1.0);  // directors are of unit length
    const bool is_node = block.kind == model::BlockKind::node;
    Vec3 position = Vec3::Zero();
    if (is_node) {
      position =
          position_size(block.shape, model::NodeTable::slots(point_.prev, block.owner).col(0),
                        model::NodeTable::slots(point_.next, block.owner).col(0));
      // the place of a follower is found from that of its master, and rounded as it is
      position.array() += system_.layout().lever(block.owner);
    }
    for (int i = 0; i < (is_node ? 3 : block.shape.width); ++i) {
      const int at = block.shape.position[index(i)];
      if (at < 0) continue;
      double& size = sizes[at];
      const std::size_t value = index(block.first_value + i);
      if (is_node) {
        size = position[i];
      } else if (block.kind == model::BlockKind::multipliers) {
        size = std::abs(point_.multipliers[value]) / system_.multiplier_scale();
      } else {
        const auto& unknowns = system_.model().own_blocks()[index(block.owner)].unknowns;
        size =
            std::abs(point_.own[value]) / own_scale(unknowns[index(i)], system_.multiplier_scale());
      }
    }
  }

  const System& system_;
  const EvaluatedPoint& point_;
  int first_ = 0;  // column of the block that was found last
  int end_ = 0;
  std::array<double, 12> sizes_{};
};

}  // namespace

RoundingCheck check_rounding(const System& system, const EvaluatedPoint& point, double limit,
                             double force_scale, double most) {
  UnknownSizes size_of(system, point);
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
  // @param size_of_entry  of the unknown that an entry of the matrix belongs to
  const auto judge = [&](int row, const auto& size_of_entry) {
    const double found = std::abs(residual[index(row)]);
    if (found <= limit || share > most) return;
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
    for (auto k = first; k < last && sum < enough; ++k) {
      sum += std::abs(values[k]) * size_of_entry(k);
    }
    if (sum >= enough) return;
    share = std::max(share, found / (epsilon * (roundings * sum + terms)));
  };
  // where the largest one is beyond what matters, as before the last iterations, no other need be
  // judged
  const int worst_row = system.largest_force_row();
  const bool is_above = worst_row >= 0 && std::abs(residual[index(worst_row)]) > limit;
  if (is_above) judge(worst_row, [&](auto k) { return size_of.of(column_of[k]); });
  if (is_above && share <= most) {
    const std::unique_ptr<double[]> sizes = size_of.all();
    for (int row = 0; row < num_rows && share <= most; ++row) {
      const int column = first_column[index(row)];
      if (column < 0) {
        judge(row, [&](auto k) { return sizes[index(column_of[k])]; });
      } else {
        const std::size_t first = row_begin[index(row)];
        judge(row, [&](auto k) { return sizes[index(column) + (k - first)]; });
      }
    }
  }
  const parallel::Comm& comm = system.comm();
  double worst[2] = {share, largest};
  comm.max(worst);
  const bool is_here = largest > 0.0 && largest == worst[1];
  const auto global = system.layout().rows().global(index(largest_row));
  return {worst[0], comm.max(is_here ? static_cast<int>(global) : -1)};
}

double rounding_energy(const System& system, const EvaluatedPoint& point) {
  const std::unique_ptr<double[]> sizes = UnknownSizes(system, point).all();
  const auto each_block = [&](auto action) {
    for (const Layout::LocalBlock& local : system.layout().local_blocks()) {
      const model::Block block = system.model().unknowns().block(local.block);
      action(local, block, block.kind == model::BlockKind::node);
    }
  };
  each_block([&](const Layout::LocalBlock& local, const model::Block& block, bool is_node) {
    if (is_node) return;
    std::fill_n(sizes.get() + local.first_column, block.shape.active, 0.0);
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
