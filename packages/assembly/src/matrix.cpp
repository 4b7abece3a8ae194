#include <culm/assembly/ghost_import.hpp>
#include <culm/assembly/tpetra.hpp>
#include <culm/base/large_vector.hpp>
#include <culm/math/types.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::assembly {
namespace {

Teuchos::RCP<const CrsGraph> make_graph(const Rows& rows, const Rows& columns,
                                        std::span<const std::size_t> begin,
                                        std::span<const int> column_of) {
  using Size = Teuchos::ArrayRCP<int>::size_type;
  Teuchos::ArrayRCP<std::size_t> first(static_cast<Size>(begin.size()));
  Teuchos::ArrayRCP<int> indices(static_cast<Size>(column_of.size()));
  std::ranges::copy(begin, first.begin());
  std::ranges::copy(column_of, indices.begin());
  const auto graph = Teuchos::rcp(new CrsGraph(tpetra(rows), tpetra(columns), first, indices));
  graph->expertStaticFillComplete(tpetra(rows), tpetra(rows));
  return graph;
}

Teuchos::RCP<CrsMatrix> make_matrix(const Teuchos::RCP<const CrsGraph>& graph) {
  using Values = CrsMatrix::local_matrix_device_type::values_type;
  const Values values(Kokkos::view_alloc("values", Kokkos::WithoutInitializing),
                      graph->getNodeNumEntries());
  prefer_large_pages(values.data(), values.size() * sizeof(double));
  std::fill_n(values.data(), values.size(), 0.0);
  const auto matrix = Teuchos::rcp(new CrsMatrix(graph, values));
  matrix->fillComplete(graph->getDomainMap(), graph->getRangeMap());
  return matrix;
}

Teuchos::RCP<CrsMatrix> take_rows(const Teuchos::RCP<const Map>& rows,
                                  const Eigen::SparseMatrix<double, Eigen::RowMajor>& whole) {
  std::size_t widest = 0;
  for (int row = 0; row < whole.rows(); ++row) {
    widest = std::max(widest, static_cast<std::size_t>(whole.innerVector(row).nonZeros()));
  }
  const auto matrix = Teuchos::rcp(new CrsMatrix(rows, widest));
  std::vector<GlobalIndex> columns;
  std::vector<double> values;
  for (std::size_t local = 0; local < rows->getNodeNumElements(); ++local) {
    const GlobalIndex row = rows->getGlobalElement(static_cast<int>(local));
    columns.clear();
    values.clear();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(whole, row); entry;
         ++entry) {
      columns.push_back(entry.col());
      values.push_back(entry.value());
    }
    matrix->insertGlobalValues(row, Teuchos::arrayViewFromVector(columns),
                               Teuchos::arrayViewFromVector(values));
  }
  matrix->fillComplete(rows, rows);
  return matrix;
}

// None where columns are numbered in another way.
std::unique_ptr<GhostImport> find_ghosts(const Rows& rows, const Rows& columns) {
  const auto ranks = tpetra(rows)->getComm();
  const int fits = begin_with_rows(rows, columns) ? 1 : 0;
  int all_fit = 0;
  Teuchos::reduceAll(*ranks, Teuchos::REDUCE_MIN, fits, Teuchos::outArg(all_fit));
  return all_fit == 1 ? std::make_unique<GhostImport>(rows, columns) : nullptr;
}

}  // namespace

Pattern::Pattern(const Rows& rows, const Rows& columns, std::span<const std::size_t> begin,
                 std::span<const int> column_of)
    : Pattern(std::make_shared<const Stored>(make_graph(rows, columns, begin, column_of))) {}

Pattern::Pattern(std::shared_ptr<const Stored> stored) : stored_(std::move(stored)) {}

std::vector<int> first_columns(std::span<const std::size_t> row_begin,
                               std::span<const int> column_of) {
  std::vector<int> first(row_begin.size() - 1, -1);
  for (std::size_t row = 0; row < first.size(); ++row) {
    const std::size_t begin = row_begin[row], end = row_begin[row + 1];
    // columns rise
    if (begin < end && index(column_of[end - 1] - column_of[begin]) == end - begin - 1) {
      first[row] = column_of[begin];
    }
  }
  return first;
}

Matrix::Stored::Stored(Teuchos::RCP<CrsMatrix> filled)
    : matrix(std::move(filled)),
      rows(rows_of(matrix->getRowMap())),
      columns(rows_of(matrix->getColMap())) {}

Matrix::Stored::~Stored() = default;

Matrix::Matrix(const Pattern& pattern)
    : Matrix(std::make_unique<Stored>(make_matrix(pattern.stored().graph))) {}

Matrix::Matrix(const Rows& rows, const Eigen::SparseMatrix<double>& whole)
    : Matrix(std::make_unique<Stored>(take_rows(tpetra(rows), whole))) {}

Matrix::Matrix(const Matrix& other)
    : Matrix(std::make_unique<Stored>(
          Teuchos::rcp(new CrsMatrix(*other.stored_->matrix, Teuchos::Copy)))) {}

Matrix::Matrix(std::unique_ptr<Stored> stored) : stored_(std::move(stored)) {
  const auto local = stored_->matrix->getLocalMatrixHost();
  values_ = {local.values.data(), local.values.extent(0)};
  row_begin_ = {local.graph.row_map.data(), local.graph.row_map.extent(0)};
  column_of_ = {local.graph.entries.data(), local.graph.entries.extent(0)};
}

Matrix::~Matrix() = default;

const Rows& Matrix::rows() const { return stored_->rows; }

const Rows& Matrix::columns() const { return stored_->columns; }

std::size_t Matrix::total_entries() const { return stored_->matrix->getGlobalNumEntries(); }

std::vector<double> Matrix::diagonal() const {
  TpetraVector found(stored_->matrix->getRowMap());
  stored_->matrix->getLocalDiagCopy(found);
  const auto values = values_of(std::as_const(found));
  return {values.begin(), values.end()};
}

// Tpetra would keep a copy of x over all columns as long as the matrix. On one rank as on several,
// so that sums are rounded the same way.
void Matrix::multiply(const Vector& x, Vector& y) const {
  if (!stored_->ghosts) stored_->ghosts = find_ghosts(rows(), columns());
  GhostImport* const ghosts = stored_->ghosts->get();
  if (ghosts == nullptr) return stored_->matrix->apply(tpetra(x), tpetra(y));
  const ColumnValues all = (*ghosts)(x);
  const auto sums = y.values();
  for (std::size_t row = 0; row < sums.size(); ++row) {
    double sum = 0.0;
    for (std::size_t k = row_begin_[row]; k < row_begin_[row + 1]; ++k) {
      sum += values_[k] * all[column_of_[k]];
    }
    sums[row] = sum;
  }
}

// Tpetra remembers the norm that it found first, whatever values are written since.
double Matrix::norm() const {
  double mine = 0.0;
  for (const double value : values()) mine += value * value;
  double all = 0.0;
  Teuchos::reduceAll(*stored_->matrix->getComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return std::sqrt(all);
}

}  // namespace culm::assembly
