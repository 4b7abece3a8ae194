#include <culm/assembly/tpetra.hpp>
#include <culm/base/error.hpp>

#include "eigen_methods.hpp"

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziTpetraAdapter.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <Tpetra_Operator.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace culm::solver {
namespace {

using MultiVector = Tpetra::MultiVector<>;
using LinearOp = Tpetra::Operator<>;
using assembly::Map;
using Teuchos::RCP;
using Teuchos::rcp;

constexpr int block_size = 2;  // copies of a value that one search finds whatever the rounding

// Y = (A - shift B)^-1 B X.
class ShiftedOp final : public LinearOp {
 public:
  explicit ShiftedOp(const ShiftedPencil& op)
      : op_(op), map_(assembly::tpetra(op.pencil.B->rows())), product_(op.pencil.B->rows()) {}
  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  // Anasazi asks for nothing but the plain product.
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp, double,
             double) const override {
    for (std::size_t i = 0; i < X.getNumVectors(); ++i) {
      op_.pencil.B->multiply(assembly::view_of(*X.getVector(i)), product_);
      Vector result = assembly::view_of(*Y.getVectorNonConst(i));
      op_.inverse.solve(product_, result);
    }
  }

 private:
  const ShiftedPencil& op_;
  RCP<const Map> map_;
  mutable Vector product_;
};

// A number in [-1, 1) that depends on the unknown and not on the rank that owns it.
double start_value(assembly::GlobalIndex row, std::size_t column) {
  auto bits = static_cast<std::uint64_t>(row) * 0x9E3779B97F4A7C15U + column * 0xD1B54A32D192ED03U;
  bits = (bits ^ (bits >> 31)) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ (bits >> 29)) * 0x94D049BB133111EBU;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
}

// Start vectors within the range of the operator, so that nothing without B is in them.
RCP<MultiVector> make_start(const ShiftedOp& op) {
  const RCP<const Map> map = op.getDomainMap();
  MultiVector first(map, block_size);
  for (std::size_t i = 0; i < block_size; ++i) {
    const auto column = first.getVectorNonConst(i);
    const auto values = assembly::values_of(*column);
    for (std::size_t row = 0; row < values.size(); ++row) {
      values[row] = start_value(map->getGlobalElement(static_cast<int>(row)), i);
    }
  }
  const auto start = rcp(new MultiVector(map, block_size));
  op.apply(first, *start, Teuchos::NO_TRANS, 1.0, 0.0);
  return start;
}

RCP<MultiVector> distribute(const Eigen::MatrixXd& columns, const RCP<const Map>& map,
                            const WholeVector& whole) {
  const auto pieces = rcp(new MultiVector(map, static_cast<std::size_t>(columns.cols())));
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const auto piece = pieces->getVectorNonConst(static_cast<std::size_t>(i));
    whole.take(columns.col(i), assembly::values_of(*piece));
  }
  return pieces;
}

Eigen::MatrixXd collect(const MultiVector& pieces, const WholeVector& whole) {
  Eigen::MatrixXd columns(whole.size(), static_cast<Eigen::Index>(pieces.getNumVectors()));
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const auto piece = pieces.getVector(static_cast<std::size_t>(i));
    whole.join(assembly::values_of(*piece), columns.col(i));
  }
  return columns;
}

Teuchos::ParameterList search_parameters(int space, int vectors) {
  const int blocks = space / block_size + 1;
  Teuchos::ParameterList list;
  list.set("Which", "LM");
  list.set("Block Size", block_size);
  list.set("Num Blocks", std::min(blocks, vectors / block_size));
  list.set("Maximum Restarts", most_restarts);
  list.set("Convergence Tolerance", krylov_tolerance);
  list.set("Relative Convergence Tolerance", true);
  list.set("Orthogonalization", "DGKS");
  list.set("Verbosity", static_cast<int>(Anasazi::Errors));
  const RCP<std::ostream> nowhere = rcp(new Teuchos::oblackholestream);
  list.set("Output Stream", Teuchos::fancyOStream(nowhere));
  return list;
}

}  // namespace

InvertedPairs solve_krylov_schur(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found) {
  const auto shifted = rcp(new ShiftedOp(op));
  const RCP<const Map> map = shifted->getDomainMap();
  const WholeVector& whole = op.inverse.whole();
  const RCP<const LinearOp> inverse = shifted;
  const RCP<const LinearOp> B = assembly::tpetra(*op.pencil.B);
  using Problem = Anasazi::BasicEigenproblem<double, MultiVector, LinearOp>;
  const auto problem = rcp(new Problem(inverse, B, make_start(*shifted)));
  problem->setHermitian(true);
  problem->setNEV(count);
  if (found.cols() > 0) problem->setAuxVecs(distribute(found, map, whole));
  internal_check(problem->setProblem(), "Anasazi takes the problem");
  InvertedPairs pairs;
  const int vectors = whole.size() - static_cast<int>(found.cols());
  pairs.convergence = widen(count, vectors, [&](int space) {
    Teuchos::ParameterList list = search_parameters(space, vectors);
    Anasazi::BlockKrylovSchurSolMgr<double, MultiVector, LinearOp> solver(problem, list);
    const bool converged = solver.solve() == Anasazi::Converged;
    return converged ? count : std::min(problem->getSolution().numVecs, count - 1);
  });
  if (pairs.convergence.converged < count) return pairs;
  const auto& solution = problem->getSolution();

  // values that differ by rounding may have come as a complex pair with the two parts of a vector
  pairs.nu.resize(solution.numVecs);
  for (int i = 0; i < solution.numVecs; ++i) {
    pairs.nu[i] = solution.Evals[static_cast<std::size_t>(i)].realpart;
  }
  pairs.vectors = collect(*solution.Evecs, whole);
  return pairs;
}

}  // namespace culm::solver
