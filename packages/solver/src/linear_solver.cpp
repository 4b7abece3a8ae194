#include <culm/solver/linear_solver.hpp>

#include "mumps_solver.hpp"

#include <fmt/format.h>

#include <utility>

namespace culm::solver {
namespace {

// Where the times of Block LU and MUMPS cross on one rank, on long strips of a shell as on square
// ones (tests/benchmark).
constexpr double widest_front_for_blocks = 95.0;

// For models that are held or rigid altogether.
class NothingToSolve final : public LinearSolver {
 public:
  std::string name() const override { return "none"; }
  bool factor() override { return true; }
  LinearResidual solve(const Vector&, Vector&) override { return {}; }
  Determinant determinant() override { return {1, 0.0}; }
  double weakest_direction(Vector&) override { return 0.0; }
};

}  // namespace

const std::vector<std::string>& linear_solver_names() {
  static const std::vector<std::string> names = {"Automatic", "Block LU", "KLU2", "MUMPS"};
  return names;
}

ChosenSolver choose_linear_solver(const std::string& name,
                                  const Teuchos::RCP<const assembly::CrsMatrix>& matrix,
                                  const parallel::Comm& comm) {
  if (matrix->getGlobalNumRows() == 0) {
    return {std::make_unique<NothingToSolve>(), "none, for there are no unknowns"};
  }
  if (name == "Block LU") return {make_rooted_block_lu(matrix, comm), "Block LU, as the deck says"};
  if (name == "KLU2") return {make_rooted_klu2(matrix, comm), "KLU2, as the deck says"};
  if (name == "MUMPS") return {make_mumps(matrix, comm), "MUMPS, as the deck says"};
  Ordering ordering = order_rows(*matrix, comm);
  const double front = ordering.fill.front();
  const bool is_wide = front > widest_front_for_blocks;
  ChosenSolver chosen;
  chosen.reason = fmt::format(
      "{}, automatic: fronts of {:.0f} unknowns predicted, MUMPS from {:.0f}; factors {:.2g} MB",
      is_wide ? "MUMPS" : "Block LU", front, widest_front_for_blocks, 8e-6 * ordering.fill.entries);
  chosen.solver =
      is_wide ? make_mumps(matrix, std::move(ordering), comm) : make_rooted_block_lu(matrix, comm);
  return chosen;
}

}  // namespace culm::solver
