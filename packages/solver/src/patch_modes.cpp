#include "patch_modes.hpp"

#include <culm/math/types.hpp>

#include "node_blocks.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace culm::solver {
namespace {

using assembly::tpetra;

// Of modes below the first value the polynomial of the smoother leaves nearly everything: a patch
// with one is worth its cost, and then takes its modes up to the second value. In a plate whose
// elements are ten times as long as thick the first has 0.01, the next two 0.3 and further ones 0.5
// and more.
constexpr double soft = 0.1;
constexpr double rather_soft = 0.4;
constexpr double hardly_known = 1e-10;  // what is below may be nothing but rounding

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Rows of the nodes at the border of this rank, for the ranks beside.
NodeBlocks rows_at_border(const GridLevel& grid) {
  const auto& global = *grid.matrix()->getColMap();
  NodeBlocks rows;
  for (int node = 0; node < grid.nodes(); ++node) {
    const int height = grid.width(node);
    rows.add_node(height);
    const auto columns = grid.rows().columns(node);
    const auto is_beside = [&](int column) { return grid.node_of(column) >= grid.nodes(); };
    if (std::ranges::none_of(columns, is_beside)) continue;
    const Eigen::Map<const RowMajor> row(grid.rows().values(node), height,
                                         static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size();) {
      const int width = grid.width(grid.node_of(columns[k]));
      double* block = rows.add_block(global.getGlobalElement(columns[k]), width);
      Eigen::Map<RowMajor>(block, height, width) =
          row.middleCols(static_cast<Eigen::Index>(k), width);
      k += index(width);
    }
  }
  return rows;
}

// Nodes of this rank and beside, and what couples them.
class Couplings {
 public:
  Couplings(const GridLevel& grid, const parallel::Comm& comm)
      : grid_(grid),
        theirs_(import_nodes(rows_at_border(grid), grid.begin(), grid.beside(), comm)),
        first_node_(grid.begin()[index(comm.rank())]),
        neighbours_(index(grid.all_nodes())) {
    const auto& map = *grid.matrix()->getColMap();
    for (int node = 0; node < grid.all_nodes(); ++node) {
      std::vector<int>& list = neighbours_[index(node)];
      if (node < grid.nodes()) {
        for (int column : grid.rows().columns(node)) {
          const int other = grid.node_of(column);
          if (list.empty() || list.back() != other) list.push_back(other);
        }
      } else {
        const std::size_t at = index(node - grid.nodes());
        for (std::size_t b = theirs_.first[at]; b < theirs_.first[at + 1]; ++b) {
          const int column = map.getLocalElement(theirs_.blocks[b].first_unknown);
          if (column >= 0) list.push_back(grid.node_of(column));
        }
      }
      std::ranges::sort(list);
    }
  }

  // Of a node, with itself, in order.
  const std::vector<int>& neighbours(int node) const { return neighbours_[index(node)]; }
  bool couples(int a, int b) const { return std::ranges::binary_search(neighbours(a), b); }
  long long global(int node) const {
    return node < grid_.nodes() ? first_node_ + node : grid_.beside()[index(node - grid_.nodes())];
  }

  // The block of a row of nodes that are coupled.
  Eigen::MatrixXd block(int row, int column) const {
    const int first = grid_.first_column(column);
    const int height = grid_.width(row), width = grid_.width(column);
    if (row < grid_.nodes()) {
      const auto columns = grid_.rows().columns(row);
      const auto at = std::ranges::find(columns, first) - columns.begin();
      const Eigen::Map<const RowMajor> values(grid_.rows().values(row), height,
                                              static_cast<Eigen::Index>(columns.size()));
      return values.middleCols(at, width);
    }
    const long long wanted = grid_.matrix()->getColMap()->getGlobalElement(first);
    const auto found = std::ranges::find(
        theirs_.blocks.begin() +
            static_cast<std::ptrdiff_t>(theirs_.first[index(row - grid_.nodes())]),
        theirs_.blocks.end(), wanted, &NodeBlocks::Block::first_unknown);
    return Eigen::Map<const RowMajor>(theirs_.values.data() + found->value, height, width);
  }

 private:
  const GridLevel& grid_;
  NodeBlocks theirs_;
  long long first_node_;
  std::vector<std::vector<int>> neighbours_;
};

using Patch = std::vector<int>;

bool are_coupled(const Patch& patch, const Couplings& couplings) {
  for (std::size_t a = 0; a < patch.size(); ++a) {
    for (std::size_t b = a + 1; b < patch.size(); ++b) {
      if (!couplings.couples(patch[a], patch[b])) return false;
    }
  }
  return true;
}

// Those whose lowest node is a given one of this rank. Of an element the nodes of a diagonal have
// no other common neighbours than the rest of the element.
std::vector<Patch> patches_from(int node, const Couplings& couplings) {
  const auto is_lower = [&](int member) {
    return couplings.global(member) < couplings.global(node);
  };
  std::vector<Patch> patches;
  for (int other : couplings.neighbours(node)) {
    Patch patch;
    std::ranges::set_intersection(couplings.neighbours(node), couplings.neighbours(other),
                                  std::back_inserter(patch));
    const bool is_known = std::ranges::find(patches, patch) != patches.end();
    if (patch.size() != 4 || is_known || std::ranges::any_of(patch, is_lower)) continue;
    if (are_coupled(patch, couplings)) patches.push_back(std::move(patch));
  }
  return patches;
}

// Its soft modes, one in each column, with v^T A v = 1.
Eigen::MatrixXd find_modes(const Patch& patch, const GridLevel& grid, const Couplings& couplings) {
  std::vector<Eigen::Index> first{0};
  for (int node : patch) first.push_back(first.back() + grid.width(node));
  // lower triangles, by the rows of this rank where it has them
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(first.back(), first.back());
  Eigen::MatrixXd D = A;
  for (std::size_t a = 0; a < patch.size(); ++a) {
    const int width = grid.width(patch[a]);
    D.block(first[a], first[a], width, width) = couplings.block(patch[a], patch[a]);
    A.block(first[a], first[a], width, width) = D.block(first[a], first[a], width, width);
    for (std::size_t b = a + 1; b < patch.size(); ++b) {
      A.block(first[b], first[a], grid.width(patch[b]), width) =
          couplings.block(patch[a], patch[b]).transpose();
    }
  }
  const auto is_positive = [](const Eigen::MatrixXd& matrix) {
    return Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
  };
  // most patches end here, at little cost
  if (is_positive(A - soft * D) || !is_positive(D)) return {};
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all(A, D);
  Eigen::MatrixXd modes(first.back(), 0);
  for (Eigen::Index k = 0; k < all.eigenvalues().size(); ++k) {
    const double lambda = all.eigenvalues()[k];
    if (lambda < hardly_known || lambda > rather_soft) continue;
    modes.conservativeResize(Eigen::NoChange, modes.cols() + 1);
    modes.rightCols<1>() = all.eigenvectors().col(k) / std::sqrt(lambda);
  }
  return modes;
}

}  // namespace

PatchModes::PatchModes(const GridLevel& grid, const std::vector<bool>& carried,
                       const parallel::Comm& comm)
    : grid_(grid),
      columns_(assembly::rows_of(grid.matrix()->getColMap())),
      sums_(columns_.rows()),
      sum_(assembly::rows_of(grid.matrix()->getRowMap())) {
  const Couplings couplings(grid, comm);
  const std::vector<bool> left_out = grid.share(carried);
  const auto is_left_out = [&](int node) { return left_out[index(node)]; };
  std::vector<int> first_row{0};
  std::vector<std::size_t> first_column{0};
  std::vector<int> columns;
  std::vector<float> values;
  for (int node = 0; node < grid.nodes(); ++node) {
    for (const Patch& patch : patches_from(node, couplings)) {
      if (std::ranges::any_of(patch, is_left_out)) continue;
      const Eigen::MatrixXf modes = find_modes(patch, grid, couplings).cast<float>();
      if (modes.cols() == 0) continue;
      for (int member : patch) {
        for (int k = 0; k < grid.width(member); ++k) {
          columns.push_back(grid.first_column(member) + k);
        }
      }
      first_row.push_back(first_row.back() + static_cast<int>(modes.cols()));
      first_column.push_back(columns.size());
      values.insert(values.end(), modes.data(), modes.data() + modes.size());
    }
  }
  count_ = static_cast<long long>(comm.sum(static_cast<double>(first_row.back())));
  if (count_ == 0) return;
  columns.shrink_to_fit();
  values.shrink_to_fit();
  modes_ = {RowGroups(std::move(first_row), std::move(first_column), std::move(columns)),
            std::move(values)};
}

void PatchModes::add(const assembly::Vector& r, assembly::Vector& z) {
  const auto importer = grid_.matrix()->getGraph()->getImporter();
  if (importer.is_null()) return modes_.add_projection(r.values(), z.values());
  tpetra(columns_).doImport(tpetra(r), *importer, Tpetra::INSERT);
  sums_.fill(0.0);
  modes_.add_projection(std::as_const(columns_).values(), sums_.values());
  sum_.fill(0.0);
  tpetra(sum_).doExport(tpetra(sums_), *importer, Tpetra::ADD);
  z.update(1.0, sum_);
}

}  // namespace culm::solver
