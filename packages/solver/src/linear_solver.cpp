#include <culm/solver/linear_solver.hpp>

#include "mumps_solver.hpp"
#include "one_factorisation.hpp"
#include "one_rank_solver.hpp"
#include "substructured_solver.hpp"

#include <fmt/format.h>

#include <utility>

namespace culm::solver {
namespace {

// Up to here Block LU is faster than MUMPS on one rank, on square sheets of a shell even if MUMPS
// finds the values symmetric, on long strips by far (tests/benchmark).
constexpr double widest_slender_front = 95.0;

// For models that are held or rigid altogether.
class NothingToSolve final : public LinearSolver {
 public:
  std::string name() const override { return "none"; }
  bool factor() override { return true; }
  LinearResidual solve(const Vector&, Vector&) override { return {}; }
  Determinant determinant() override { return {1, 0.0}; }
  double weakest_direction(Vector&) override { return 0.0; }
};

// An estimate [B per entry of the matrix] of the grids, the factors of the coarsest and the vectors
// of conjugate gradients: plates of 200 x 200 to 700 x 700 elements took 16 to 20, those with
// elements longer than thick 28 to 32, or 20 where memory is short and they have three grids.
constexpr double iterative_need = 22.0;

ChosenSolver choose_iterative(const std::string& why,
                              const std::shared_ptr<const assembly::Matrix>& matrix,
                              const parallel::Comm& comm, const ModelBehind& model) {
  return {make_iterative(matrix, model, comm),
          "Iterative, " + why + "; it knows no determinants, so bifurcations are not looked for",
          true,
          {},
          iterative_need * static_cast<double>(matrix->total_entries()),
          true};
}

// From here on ranks gain by factoring together. Below, one rank factors all, which hardly takes
// longer and gives the same digits on any number of ranks, and each time.
constexpr std::size_t fewest_shared_unknowns = 20000;

bool is_shared(const assembly::Matrix& matrix, const parallel::Comm& comm) {
  return comm.size() > 1 && matrix.rows().total() >= fewest_shared_unknowns;
}

std::unique_ptr<LinearSolver> make_block_lu(const std::shared_ptr<const assembly::Matrix>& matrix,
                                            const parallel::Comm& comm) {
  return is_shared(*matrix, comm) ? make_substructured(matrix, comm)
                                  : make_rooted_block_lu(matrix, comm);
}

std::unique_ptr<LinearSolver> make_wide(const std::shared_ptr<const assembly::Matrix>& matrix,
                                        Ordering ordering, const parallel::Comm& comm) {
  const auto stored = assembly::tpetra(*matrix);
  if (is_shared(*matrix, comm)) {
    return make_shared_mumps(stored, std::move(ordering), comm);
  }
  const auto alone = [&](const auto& whole, const parallel::Comm& one) {
    return make_mumps(whole, std::move(ordering), one);
  };
  return make_one_rank_solver(stored, alone, comm);
}

double bytes_of(const Fill& fill) { return sizeof(double) * fill.entries; }

bool is_wide(const Fill& fill) { return fill.front() > widest_slender_front; }

// Nested dissection is done by one rank, which all others wait for: a million beams took it 3.5 s.
// Where large matrices are slender as they stand, there is no need of it.
bool is_slender_as_it_stands(const Fill& bound, const parallel::Comm& comm,
                             const ModelBehind& model) {
  return !is_wide(bound) && bytes_of(bound) <= model.memory * comm.size();
}

using MakeSolver = std::unique_ptr<LinearSolver>(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm);

// @param make_slender for what Block LU is made for
ChosenSolver choose(const std::string& name, const std::shared_ptr<const assembly::Matrix>& matrix,
                    const parallel::Comm& comm, const ModelBehind& model,
                    MakeSolver* make_slender) {
  if (matrix->rows().total() == 0) {
    return {std::make_unique<NothingToSolve>(), "none, for there are no unknowns"};
  }
  if (name == "Block LU") return {make_slender(matrix, comm), "Block LU, as the deck says"};
  if (name == "KLU2") return {make_rooted_klu2(matrix, comm), "KLU2, as the deck says"};
  if (name == "MUMPS") {
    return {make_wide(matrix, order_rows(*assembly::tpetra(*matrix), comm), comm),
            "MUMPS, as the deck says"};
  }
  if (name == "Iterative" && model.motions) {
    return choose_iterative("as the deck says", matrix, comm, model);
  }
  if (matrix->rows().total() >= fewest_shared_unknowns) {
    const Fill bound = bound_fill(*matrix, comm);
    if (is_slender_as_it_stands(bound, comm, model)) {
      ChosenSolver chosen{make_slender(matrix, comm), {}};
      chosen.fill = bound;
      chosen.reason =
          fmt::format("{}, automatic: fronts of at most {:.0f} unknowns, MUMPS from {:.0f}",
                      chosen.solver->name(), bound.front(), widest_slender_front);
      return chosen;
    }
  }
  Ordering ordering = order_rows(*assembly::tpetra(*matrix), comm);
  const Fill fill = ordering.fill;
  const double bytes = bytes_of(fill);
  if (bytes > model.memory * comm.size() && model.motions) {
    return choose_iterative(
        fmt::format("automatic: factors of {:.2g} GB predicted, {:.2g} GB allowed", 1e-9 * bytes,
                    1e-9 * model.memory * comm.size()),
        matrix, comm, model);
  }
  ChosenSolver chosen;
  chosen.fill = fill;
  chosen.solver =
      is_wide(fill) ? make_wide(matrix, std::move(ordering), comm) : make_slender(matrix, comm);
  chosen.reason = fmt::format(
      "{}, automatic: fronts of {:.0f} unknowns predicted, MUMPS from {:.0f}; factors {:.2g} MB",
      chosen.solver->name(), fill.front(), widest_slender_front, 1e-6 * bytes);
  return chosen;
}

}  // namespace

const std::vector<std::string>& linear_solver_names() {
  static const std::vector<std::string> names = {"Automatic", "Block LU", "KLU2", "MUMPS",
                                                 "Iterative"};
  return names;
}

ChosenSolver choose_linear_solver(const std::string& name,
                                  const std::shared_ptr<const assembly::Matrix>& matrix,
                                  const parallel::Comm& comm, const ModelBehind& model) {
  ChosenSolver chosen = choose(name, matrix, comm, model, make_block_lu);
  chosen.is_shared |= name != "KLU2" && is_shared(*matrix, comm);
  return chosen;
}

ChosenSolver choose_for_one_factorisation(const std::string& name,
                                          const std::shared_ptr<const assembly::Matrix>& matrix,
                                          const parallel::Comm& comm) {
  return choose(name, matrix, comm, {}, make_rooted_klu2);
}

}  // namespace culm::solver
