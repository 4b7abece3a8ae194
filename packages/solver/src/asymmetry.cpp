#include <culm/solver/asymmetry.hpp>

#include "rooted_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace culm::solver {
namespace {

constexpr double rounding_of_row = 1e-10;  // with room for a thousandth of it

// Largest entries of the rows, on rank 0.
std::vector<double> row_sizes(const RootedMatrix& rooted) {
  const auto A = rooted.matrix()->getLocalMatrixHost();
  std::vector<double> size(static_cast<std::size_t>(A.numRows()), 0.0);
  for (std::size_t i = 0; i < size.size(); ++i) {
    for (auto k = A.graph.row_map(i); k < A.graph.row_map(i + 1); ++k) {
      size[i] = std::max(size[i], std::abs(A.values(k)));
    }
  }
  return size;
}

// Largest |A_ij - A_ji| over the root of the sizes of rows i and j, on rank 0.
double worst_pair(const RootedMatrix& rooted, const std::vector<double>& size) {
  double worst = 0.0;
  const auto A = rooted.matrix()->getLocalMatrixHost();
  for (std::size_t i = 0; i < size.size(); ++i) {
    for (auto k = A.graph.row_map(i); k < A.graph.row_map(i + 1); ++k) {
      const auto j = static_cast<std::size_t>(A.graph.entries(k));
      const auto* first = A.graph.entries.data() + A.graph.row_map(j);
      const auto* last = A.graph.entries.data() + A.graph.row_map(j + 1);
      const auto* mirror = std::find(first, last, static_cast<int>(i));
      const double other =
          mirror == last ? 0.0
                         : A.values(static_cast<std::size_t>(mirror - A.graph.entries.data()));
      const double difference = std::abs(A.values(k) - other);
      if (difference > 0.0) worst = std::max(worst, difference / std::sqrt(size[i] * size[j]));
    }
  }
  return worst;
}

}  // namespace

double asymmetry(const std::shared_ptr<const assembly::Matrix>& matrix,
                 const parallel::Comm& comm) {
  RootedMatrix rooted(assembly::tpetra(*matrix), comm);
  rooted.gather_values();
  return comm.max(comm.is_root() ? worst_pair(rooted, row_sizes(rooted)) : 0.0);
}

double asymmetry_within(const std::shared_ptr<const assembly::Matrix>& part,
                        const std::shared_ptr<const assembly::Matrix>& whole,
                        const parallel::Comm& comm) {
  RootedMatrix rooted(assembly::tpetra(*part), comm);
  RootedMatrix beside(assembly::tpetra(*whole), comm);
  rooted.gather_values();
  beside.gather_values();
  double worst = 0.0;
  if (comm.is_root()) {
    std::vector<double> size = row_sizes(rooted);
    const std::vector<double> of_whole = row_sizes(beside);
    for (std::size_t i = 0; i < size.size(); ++i) {
      size[i] = std::max(size[i], rounding_of_row * of_whole[i]);
    }
    worst = worst_pair(rooted, size);
  }
  return comm.max(worst);
}

}  // namespace culm::solver
