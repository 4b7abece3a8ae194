#include "multigrid.hpp"

#include <culm/math/types.hpp>

#include "coarse_matrix.hpp"
#include "prolongation.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace culm::solver {
namespace {

using assembly::tpetra;
using assembly::Vector;

// The coarsest grid is factored. Below so many unknowns that costs less than cycles over more
// grids.
constexpr double always_factored = 200000.0;
// A further grid takes more iterations, up to four times as many for a thin shell. So a larger one
// is factored as well, while that costs no more than some dozen iterations: so many operations, on
// dense blocks and ten times as fast as others, for each entry of the finest matrix.
constexpr double operations_per_entry = 1e4;
// A grid that is not much coarser than the one before is not worth its cost.
constexpr double least_coarsening = 0.7;

// What neither a smoother nor rigid motions can stand for.
std::vector<bool> find_special(const GridLevel& grid, const BlockSmoother& smoother) {
  std::vector<bool> special(index(grid.nodes()));
  for (int node = 0; node < grid.nodes(); ++node) {
    const auto rigid = grid.rigid().middleRows(grid.first_column(node), grid.width(node));
    special[index(node)] = smoother.leaves(node) || rigid.isZero(0.0);
  }
  return special;
}

// That with its neighbours.
std::vector<bool> with_neighbours(const std::vector<bool>& special, const GridLevel& grid) {
  const std::vector<bool> all = grid.share(special);
  std::vector<bool> carried = special;
  for (int node = 0; node < grid.nodes(); ++node) {
    for (int column : grid.rows().columns(node)) {
      if (all[index(grid.node_of(column))]) carried[index(node)] = true;
    }
  }
  return carried;
}

double rows_of(const assembly::CrsMatrix& matrix) {
  return static_cast<double>(matrix.getGlobalNumRows());
}

}  // namespace

struct Multigrid::Level {
  Level(Teuchos::RCP<const assembly::CrsMatrix> matrix, const std::vector<int>& widths,
        NearNullSpace rigid, const parallel::Comm& comm)
      : grid(std::move(matrix), widths, std::move(rigid), comm), smoother(grid) {}

  GridLevel grid;
  BlockSmoother smoother;
  GroupedMatrix prolongation;  // to this grid, over the columns of the next matrix
  Teuchos::RCP<const assembly::CrsMatrix> next;
  std::optional<Vector> coarse_rhs, coarse_solution, coarse_columns;
};

Multigrid::Multigrid(const Teuchos::RCP<const assembly::CrsMatrix>& matrix,
                     assembly::NodeMotions nodes, double memory, const parallel::Comm& comm) {
  coarsest_matrix_ = matrix;
  Surface surface{std::move(nodes.places), std::move(nodes.normals)};
  while (levels_.empty() || !is_worth_factors(memory, comm)) {
    auto level = std::make_unique<Level>(coarsest_matrix_, nodes.widths, nodes.rigid, comm);
    const std::vector<bool> special = find_special(level->grid, level->smoother);
    const bool all_move = std::ranges::find(special, true) == special.end();
    may_be_definite_ = may_be_definite_ && comm.max(all_move ? 0 : 1) == 0;
    const std::vector<bool> carried = with_neighbours(special, level->grid);
    level->smoother.add_modes(carried, comm);
    // Many nodes bend without shear where few do; else that only makes the next grid larger.
    if (!level->smoother.has_modes()) surface = {};
    const Aggregates aggregates = aggregate(level->grid, carried);
    Prolongation coarse = join(level->grid, aggregates, carried, surface, comm);
    const bool pays =
        static_cast<double>(coarse.begin.back()) < least_coarsening * rows_of(*coarsest_matrix_);
    if (!levels_.empty() && !pays) break;
    const NodeBlocks smoothed = smooth(coarse.rows, level->grid, level->smoother, comm);
    coarsest_matrix_ = make_coarse_matrix(level->grid, smoothed, coarse.widths, coarse.begin, comm);
    level->next = coarsest_matrix_;
    level->prolongation = over_columns(smoothed, *coarsest_matrix_->getColMap());
    level->coarse_rhs.emplace(assembly::rows_of(coarsest_matrix_->getRowMap()));
    level->coarse_solution.emplace(level->coarse_rhs->rows());
    level->coarse_columns.emplace(assembly::rows_of(coarsest_matrix_->getColMap()));
    levels_.push_back(std::move(level));
    nodes = {std::move(coarse.widths), std::move(coarse.rigid), {}, {}};
    surface = {};
  }
  is_regular_ = coarsest_->factor();
}

// Leaves the solver of the coarsest matrix, by whose order factors are predicted.
bool Multigrid::is_worth_factors(double memory, const parallel::Comm& comm) {
  ChosenSolver chosen =
      choose_linear_solver("Automatic", assembly::matrix_of(coarsest_matrix_), comm);
  coarsest_ = std::move(chosen.solver);
  if (rows_of(*coarsest_matrix_) <= always_factored) return true;
  const auto entries = static_cast<double>(levels_.front()->grid.matrix()->getGlobalNumEntries());
  if (chosen.fill.operations > operations_per_entry * entries) return false;
  const bool fits = sizeof(double) * chosen.fill.entries <= memory;
  lacks_memory_ = lacks_memory_ || !fits;
  return fits;
}

Multigrid::~Multigrid() = default;

void Multigrid::refresh() { levels_.front()->smoother.refresh(); }

void Multigrid::multiply(const Vector& x, Vector& y) const { levels_.front()->grid.multiply(x, y); }

void Multigrid::add_prolonged(std::size_t level, const Vector& coarse, Vector& x) const {
  Level& l = *levels_[level];
  const auto importer = l.next->getGraph()->getImporter();
  if (importer.is_null()) {
    *l.coarse_columns = coarse;
  } else {
    tpetra(*l.coarse_columns).doImport(tpetra(coarse), *importer, Tpetra::INSERT);
  }
  l.prolongation.add_product(std::as_const(*l.coarse_columns).values(), x.values());
}

void Multigrid::cycle(std::size_t level, const Vector& b, Vector& x) {
  if (level == levels_.size()) {
    coarsest_->solve(b, x);
    return;
  }
  Level& l = *levels_[level];
  l.smoother.smooth(b, x);
  l.coarse_columns->fill(0.0);
  l.prolongation.add_transposed(l.smoother.find_rest().values(), l.coarse_columns->values());
  const auto importer = l.next->getGraph()->getImporter();
  if (importer.is_null()) {
    l.coarse_rhs = l.coarse_columns;
  } else {
    l.coarse_rhs->fill(0.0);
    tpetra(*l.coarse_rhs).doExport(tpetra(*l.coarse_columns), *importer, Tpetra::ADD);
  }
  cycle(level + 1, *l.coarse_rhs, *l.coarse_solution);
  add_prolonged(level, *l.coarse_solution, x);
  l.smoother.smooth_further(b, x);
}

void Multigrid::apply(const Vector& b, Vector& x) { cycle(0, b, x); }

void Multigrid::weakest_direction(Vector& v) {
  Vector coarse(assembly::rows_of(coarsest_matrix_->getRowMap()));
  coarsest_->weakest_direction(coarse);
  for (std::size_t level = levels_.size(); level-- > 0;) {
    Vector fine(assembly::rows_of(levels_[level]->grid.matrix()->getRowMap()));
    add_prolonged(level, coarse, fine);
    coarse = std::move(fine);
  }
  v = coarse;
}

std::vector<long long> Multigrid::sizes() const {
  std::vector<long long> sizes;
  for (const auto& level : levels_) {
    sizes.push_back(static_cast<long long>(level->grid.matrix()->getGlobalNumRows()));
  }
  sizes.push_back(static_cast<long long>(coarsest_matrix_->getGlobalNumRows()));
  return sizes;
}

}  // namespace culm::solver
