#include "coarse_matrix.hpp"

#include <culm/math/types.hpp>

#include "exchange.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace culm::solver {
namespace {

using assembly::CrsGraph;
using assembly::CrsMatrix;
using assembly::GlobalIndex;
using assembly::Map;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Block = Eigen::Map<RowMajor>;
using ConstBlock = Eigen::Map<const RowMajor>;

// Coarse nodes that occur on this rank, each with a local number; its own ones come first.
class CoarseNodes {
 public:
  CoarseNodes(const std::vector<int>& widths, long long first) {
    for (int width : widths) {
      add(first, width);
      first += width;
    }
    own_ = size();
  }
  int add(long long first_unknown, int width) {
    const auto [found, is_new] = number_.try_emplace(first_unknown, size());
    if (is_new) {
      first_.push_back(first_unknown);
      widths_.push_back(width);
    }
    return found->second;
  }
  int size() const { return static_cast<int>(first_.size()); }
  int own() const { return own_; }
  int width(int node) const { return widths_[index(node)]; }
  long long first_unknown(int node) const { return first_[index(node)]; }

 private:
  std::unordered_map<long long, int> number_;
  std::vector<long long> first_;
  std::vector<int> widths_;
  int own_ = 0;
};

// Rows of blocks that are added to.
class BlockSums {
 public:
  explicit BlockSums(CoarseNodes& nodes) : nodes_(nodes) {}

  // valid until the next call
  Block at(int row, int column) {
    if (rows_.size() <= index(row)) rows_.resize(index(row) + 1);
    auto& list = rows_[index(row)];
    const int height = nodes_.width(row);
    const int width = nodes_.width(column);
    auto found = std::ranges::find(list, column, &Entry::column);
    if (found == list.end()) {
      list.push_back({column, values_.size()});
      values_.resize(values_.size() + index(height) * index(width), 0.0);
      found = std::prev(list.end());
    }
    return {values_.data() + found->value, height, width};
  }

  // Brings the rows of other ranks there. Collective.
  void deliver(const std::vector<long long>& begin, const parallel::Comm& comm) {
    ByRank<long long> structure(index(comm.size()));
    ByRank<double> numbers(index(comm.size()));
    for (std::size_t row = index(nodes_.own()); row < rows_.size(); ++row) {
      const int node = static_cast<int>(row);
      const std::size_t rank = owner_of(nodes_.first_unknown(node), begin);
      for (const Entry& entry : rows_[row]) {
        structure[rank].push_back(nodes_.first_unknown(node));
        structure[rank].push_back(nodes_.width(node));
        structure[rank].push_back(nodes_.first_unknown(entry.column));
        structure[rank].push_back(nodes_.width(entry.column));
        const double* value = values_.data() + entry.value;
        numbers[rank].insert(numbers[rank].end(), value,
                             value + nodes_.width(node) * nodes_.width(entry.column));
      }
    }
    structure = exchange_lists(structure, comm);
    numbers = exchange_lists(numbers, comm);
    for (std::size_t rank = 0; rank < structure.size() && comm.size() > 1; ++rank) {
      const double* value = numbers[rank].data();
      for (std::size_t k = 0; k < structure[rank].size(); k += 4) {
        const long long* entry = structure[rank].data() + k;
        const int row = nodes_.add(entry[0], static_cast<int>(entry[1]));
        const int column = nodes_.add(entry[2], static_cast<int>(entry[3]));
        at(row, column) += ConstBlock(value, entry[1], entry[3]);
        value += entry[1] * entry[3];
      }
    }
    rows_.resize(index(nodes_.own()));
  }

  // Calls action(column, values) for the entries of a row in a given order of the columns.
  template <class Action>
  void each_entry(int row, const std::vector<int>& order, Action action) const {
    std::vector<Entry> sorted = rows_[index(row)];
    std::ranges::sort(sorted, {}, [&](const Entry& entry) { return order[index(entry.column)]; });
    for (const Entry& entry : sorted) {
      action(entry.column, ConstBlock(values_.data() + entry.value, nodes_.width(row),
                                      nodes_.width(entry.column)));
    }
  }

 private:
  struct Entry {
    int column;
    std::size_t value;
  };

  CoarseNodes& nodes_;
  std::vector<std::vector<Entry>> rows_;
  std::vector<double> values_;
};

// Local numbers of the coarse nodes of all blocks.
std::vector<int> number_blocks(const NodeBlocks& rows, CoarseNodes& nodes) {
  std::vector<int> numbers;
  for (const NodeBlocks::Block& block : rows.blocks) {
    numbers.push_back(nodes.add(block.first_unknown, block.width));
  }
  return numbers;
}

// P^T A P of the rows of this rank.
void multiply(const GridLevel& grid, const NodeBlocks& mine, const NodeBlocks& theirs,
              CoarseNodes& nodes, BlockSums& sums) {
  const std::vector<int> my_numbers = number_blocks(mine, nodes);
  const std::vector<int> their_numbers = number_blocks(theirs, nodes);
  std::vector<int> place(index(nodes.size()), -1);  // of a coarse node in the row at hand
  std::vector<int> present;
  std::vector<RowMajor> product;  // A P of the row
  for (int node = 0; node < grid.nodes(); ++node) {
    present.clear();
    const int height = grid.width(node);
    const auto columns = grid.rows().columns(node);
    const ConstBlock matrix(grid.rows().values(node), height,
                            static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size();) {
      const int other = grid.node_of(columns[k]);
      const bool is_here = other < grid.nodes();
      const NodeBlocks& source = is_here ? mine : theirs;
      const std::vector<int>& numbers = is_here ? my_numbers : their_numbers;
      const std::size_t at = index(is_here ? other : other - grid.nodes());
      const int width = grid.width(other);
      const auto coupling = matrix.middleCols(static_cast<Eigen::Index>(k), width);
      for (std::size_t b = source.first[at]; b < source.first[at + 1]; ++b) {
        int& where = place[index(numbers[b])];
        if (where < 0) {
          where = static_cast<int>(present.size());
          present.push_back(numbers[b]);
          if (product.size() < present.size()) product.emplace_back();
          product[index(where)].setZero(height, source.blocks[b].width);
        }
        const ConstBlock value(source.values.data() + source.blocks[b].value, width,
                               source.blocks[b].width);
        product[index(where)].noalias() += coupling.lazyProduct(value);
      }
      k += index(width);
    }
    for (std::size_t b = mine.first[index(node)]; b < mine.first[index(node) + 1]; ++b) {
      const ConstBlock value(mine.values.data() + mine.blocks[b].value, height,
                             mine.blocks[b].width);
      for (std::size_t p = 0; p < present.size(); ++p) {
        sums.at(my_numbers[b], present[p]).noalias() += value.transpose().lazyProduct(product[p]);
      }
    }
    for (int number : present) place[index(number)] = -1;
  }
}

// Nodes in the order of their columns: own ones, then the others by their numbers.
std::vector<int> order_columns(const CoarseNodes& nodes) {
  std::vector<int> order(index(nodes.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin() + nodes.own(), order.end(),
            [&](int a, int b) { return nodes.first_unknown(a) < nodes.first_unknown(b); });
  return order;
}

}  // namespace

Teuchos::RCP<CrsMatrix> make_coarse_matrix(const GridLevel& grid, const NodeBlocks& rows,
                                           const std::vector<int>& widths,
                                           const std::vector<long long>& begin,
                                           const parallel::Comm& comm) {
  CoarseNodes nodes(widths, begin[index(comm.rank())]);
  BlockSums sums(nodes);
  multiply(grid, rows, import_nodes(rows, grid.begin(), grid.beside(), comm), nodes, sums);
  sums.deliver(begin, comm);

  const std::vector<int> order = order_columns(nodes);
  std::vector<int> place(order.size());
  std::vector<int> first_column(order.size());
  std::vector<GlobalIndex> columns;
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[index(order[k])] = static_cast<int>(k);
    first_column[index(order[k])] = static_cast<int>(columns.size());
    for (int i = 0; i < nodes.width(order[k]); ++i) {
      columns.push_back(nodes.first_unknown(order[k]) + i);
    }
  }
  const auto mpi = grid.matrix()->getRowMap()->getComm();
  const auto total = static_cast<Tpetra::global_size_t>(begin.back());
  const auto own = index(begin[index(comm.rank()) + 1] - begin[index(comm.rank())]);
  const auto row_map = Teuchos::rcp(new Map(total, own, 0, mpi));
  const auto any = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto column_map =
      comm.size() == 1 ? row_map
                       : Teuchos::rcp(new Map(any, Teuchos::arrayViewFromVector(columns), 0, mpi));

  using Size = Teuchos::ArrayRCP<int>::size_type;
  Teuchos::ArrayRCP<std::size_t> row_begin(static_cast<Size>(own + 1), 0);
  std::vector<int> entries;
  std::vector<double> values;
  Size row = 0;
  for (int node = 0; node < nodes.own(); ++node) {
    const std::size_t first = entries.size();
    std::size_t length = 0;
    sums.each_entry(node, place,
                    [&](int, const ConstBlock& block) { length += index(block.cols()); });
    const std::size_t height = index(nodes.width(node));
    entries.resize(first + height * length);
    values.resize(entries.size());
    std::size_t at = first;
    sums.each_entry(node, place, [&](int column, const ConstBlock& block) {
      for (Eigen::Index i = 0; i < block.rows(); ++i) {
        for (Eigen::Index j = 0; j < block.cols(); ++j) {
          const std::size_t k = at + index(i) * length + index(j);
          entries[k] = first_column[index(column)] + static_cast<int>(j);
          values[k] = block(i, j);
        }
      }
      at += index(block.cols());
    });
    for (std::size_t i = 0; i < height; ++i) row_begin[++row] = first + (i + 1) * length;
  }
  Teuchos::ArrayRCP<int> indices(static_cast<Size>(entries.size()));
  std::ranges::copy(entries, indices.begin());
  const auto graph = Teuchos::rcp(new CrsGraph(row_map, column_map, row_begin, indices));
  graph->expertStaticFillComplete(row_map, row_map);
  const auto matrix = Teuchos::rcp(new CrsMatrix(graph));
  matrix->fillComplete(row_map, row_map);
  std::ranges::copy(values, matrix->getLocalMatrixHost().values.data());
  return matrix;
}

GroupedMatrix over_columns(const NodeBlocks& rows, const Map& columns) {
  std::vector<int> first_row{0};
  std::vector<std::size_t> first_column{0};
  std::vector<int> list;
  std::vector<double> values;
  for (int node = 0; node < rows.nodes(); ++node) {
    const int height = rows.heights[index(node)];
    first_row.push_back(first_row.back() + height);
    for (std::size_t b = rows.first[index(node)]; b < rows.first[index(node) + 1]; ++b) {
      const int first = columns.getLocalElement(rows.blocks[b].first_unknown);
      for (int j = 0; j < rows.blocks[b].width; ++j) list.push_back(first + j);
    }
    first_column.push_back(list.size());
    for (int i = 0; i < height; ++i) {
      for (std::size_t b = rows.first[index(node)]; b < rows.first[index(node) + 1]; ++b) {
        const double* row = rows.values.data() + rows.blocks[b].value + i * rows.blocks[b].width;
        values.insert(values.end(), row, row + rows.blocks[b].width);
      }
    }
  }
  values.shrink_to_fit();
  return {RowGroups(std::move(first_row), std::move(first_column), std::move(list)),
          std::move(values)};
}

}  // namespace culm::solver
