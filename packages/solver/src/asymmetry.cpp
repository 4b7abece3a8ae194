#include <culm/solver/eigen_solver.hpp>

#include "rooted_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace culm::solver {

double asymmetry(const std::shared_ptr<const assembly::Matrix>& matrix,
                 const parallel::Comm& comm) {
  RootedMatrix rooted(assembly::tpetra(*matrix), comm);
  rooted.gather_values();
  double worst = 0.0;
  if (comm.is_root()) {
    const auto A = rooted.matrix()->getLocalMatrixHost();
    const auto rows = static_cast<std::size_t>(A.numRows());
    std::vector<double> size(rows, 0.0);
    for (std::size_t i = 0; i < rows; ++i) {
      for (auto k = A.graph.row_map(i); k < A.graph.row_map(i + 1); ++k) {
        size[i] = std::max(size[i], std::abs(A.values(k)));
      }
    }
    for (std::size_t i = 0; i < rows; ++i) {
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
  }
  return comm.max(worst);
}

}  // namespace culm::solver
