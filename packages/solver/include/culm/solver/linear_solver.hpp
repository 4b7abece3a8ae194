/// Solution of the linear systems of a Newton iteration.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/assembly/node_motions.hpp>
#include <culm/solver/fill.hpp>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::solver {

using assembly::Vector;

/// A determinant, too large or too small for one number.
struct Determinant {
  int sign = 0;           ///< 0 if unknown
  double log_size = 0.0;  ///< natural logarithm of the absolute value
  /// Negative eigenvalues, if the matrix is symmetric and its pivots tell.
  std::optional<int> negative = {};
};

/// What is left of a linear system that was solved.
struct LinearResidual {
  /// |b - A x| in the maximum norm over the largest sum of terms of a row; of an iteration that
  /// stopped early the Euclidean norm over that of b. The same on all ranks.
  double size = 0.0;
  double allowed = 1e-8;  ///< what is more makes the solution worthless
  bool is_sound() const { return size <= allowed; }
};

/// Solves with one matrix whose pattern never changes and whose values do.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual std::string name() const = 0;
  /// Factors the present values. @return false if the matrix is singular to working precision
  virtual bool factor() = 0;
  /// The same where a solution for b is the next to follow, with b as it is now, and hardly
  /// another: a part of it may be done on the way, and what further ones need may be left out. They
  /// make it anew, of the values that were factored, which the matrix must still have.
  virtual bool factor_for(const Vector& b) {
    static_cast<void>(b);
    return factor();
  }
  /// x = A^-1 b with the last factors.
  virtual LinearResidual solve(const Vector& b, Vector& x) = 0;
  /// The same with |b - A x| <= reduction |b| only, where that costs less.
  virtual LinearResidual solve_roughly(const Vector& b, Vector& x, double reduction) {
    static_cast<void>(reduction);
    return solve(b, x);
  }
  /// Of the matrix that was factored last, from its pivots; the same on all ranks.
  virtual Determinant determinant() = 0;
  /// Approximates the direction in which A is weakest by inverse iteration on a slightly shifted
  /// copy. @return |A v| / |A| for the returned v of unit maximum norm; zero with v = 0 if not even
  /// the copy has factors, as with numbers that are not finite or differ too much in size
  virtual double weakest_direction(Vector& v) = 0;
  /// The pivots of the last factorisation are those to which restore_pivots goes back.
  virtual void remember_pivots() {}
  /// Where others were chosen since, goes back: later factorisations are as if it had not happened.
  virtual void restore_pivots() {}
  /// What later factorisations keep of earlier ones, to go on as after them, bit by bit. On the
  /// root only; empty if there is nothing, as with solvers that begin anew each time.
  virtual std::vector<int> pivots() const { return {}; }
  /// Goes on with such pivots of the same matrix. @return false if they do not fit
  virtual bool set_pivots(std::span<const int> pivots) { return pivots.empty(); }
  /// What a report should say of the factorisations so far, on the root; empty if nothing.
  virtual std::string remark() const { return {}; }
};

/// KLU2 of Amesos2 on rank 0. Values gather there in global order, so the factors, and the
/// solution, are the same for any number of ranks. The plan and the symbolic factorisation are made
/// once, and pivots are kept as long as they serve. It is called past the interface of Amesos2,
/// which chooses pivots each time and returns wrong solutions on several ranks (Trilinos 13.2 as
/// packaged by Debian, pull request 12232).
std::unique_ptr<LinearSolver> make_rooted_klu2(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm);

/// LU of dense blocks on rank 0, for graphs like chains and trees: the unknowns of a node are
/// eliminated whole, with the multipliers of a joint, and pivots are chosen among them. Where that
/// does not serve – a pivot is nothing but rounding, a solution leaves more than 1e-12 – KLU2 takes
/// over, so that the same matrices are singular as with it. The solution is the same for any number
/// of ranks.
std::unique_ptr<LinearSolver> make_rooted_block_lu(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm);

/// MUMPS on all ranks, with rows where they are. Its ordering, nested dissection of the graph of
/// nodes, and its analysis are made once. Solutions are refined where the residual is above 1e-14.
/// On several ranks sums come together in an order that may change from run to run, and with it
/// the rounding.
std::unique_ptr<LinearSolver> make_mumps(const std::shared_ptr<const assembly::Matrix>& matrix,
                                         const parallel::Comm& comm);

/// What an iterative solver wants to know of the model behind the matrix.
struct ModelBehind {
  /// At the point where the matrix was taken; none: there is no iterative solver. Collective.
  std::function<assembly::NodeMotions()> motions = {};
  /// What factors may need at most in each process [B].
  double memory = std::numeric_limits<double>::infinity();
};

/// Conjugate gradients, or GMRES where the matrix is not symmetric or not definite, by Belos, with
/// multigrid on the nodes of the model: smoothed aggregation whose near null space are the rigid
/// motions. The grids serve until remember_pivots or restore_pivots is called, or iterations become
/// many. Each solution is checked; where the iteration does not converge, MUMPS takes over until
/// then, or NumericalError is thrown if its factors do not fit into the memory.
std::unique_ptr<LinearSolver> make_iterative(const std::shared_ptr<const assembly::Matrix>& matrix,
                                             ModelBehind model, const parallel::Comm& comm);

/// A solver, and a sentence for reports: its name and why it was taken.
struct ChosenSolver {
  std::unique_ptr<LinearSolver> solver;
  std::string reason;
  bool is_iterative = false;  ///< it asks for the motions of the model behind
  Fill fill = {};             ///< predicted, where Automatic took a direct one by that
  double bytes = 0.0;         ///< predicted need of an iterative solver, on all ranks together [B]
  bool is_shared = false;     ///< whether all ranks hold parts of what it needs, or rank 0 all
};

/// What decks may write, the default first.
const std::vector<std::string>& linear_solver_names();

/// The solver of that name. `Automatic` takes Block LU for graphs like beams and MUMPS for graphs
/// like shells, whose factors are so dense that MUMPS gains by its dense kernels; it decides by
/// predict_fill, for large matrices by bound_fill where that is enough. Small matrices are factored
/// on rank 0: solutions are the same on any number of ranks, and each time. From 20 000 unknowns on
/// all ranks work together. Where the factors would not fit into the memory, it takes the iterative
/// solver. Collective.
ChosenSolver choose_linear_solver(const std::string& name,
                                  const std::shared_ptr<const assembly::Matrix>& matrix,
                                  const parallel::Comm& comm, const ModelBehind& model = {});

}  // namespace culm::solver
