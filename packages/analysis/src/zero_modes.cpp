#include "zero_modes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace culm::analysis {
namespace {

// Orthonormal combinations of columns, each of which is three components at some points: by the sum
// of their squares, the largest first. Weights keep directions apart that are alike else.
Eigen::MatrixXd by_size(const Eigen::MatrixXd& columns, Eigen::VectorXd& squares) {
  const Vec3 weights(1.0, 0.8, 0.6);
  Eigen::MatrixXd weighted = columns;
  for (Eigen::Index i = 0; i < weighted.rows(); ++i) weighted.row(i) *= weights[i % 3];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> found(weighted.transpose() * weighted);
  squares = found.eigenvalues().reverse();
  return found.eigenvectors().rowwise().reverse();
}

// Combinations of motions of unit energy: those with momentum, then the others by what they
// displace.
Eigen::MatrixXd choose_combinations(const Eigen::MatrixXd& momentum,
                                    const Eigen::MatrixXd& displaced, double mass) {
  constexpr double rounding = 1e-8;  // of squares, which are effective masses
  Eigen::VectorXd squares;
  Eigen::MatrixXd chosen = by_size(momentum, squares);
  const Eigen::Index moving = (squares.array() > rounding * mass).count();
  const Eigen::Index rest = chosen.cols() - moving;
  if (rest == 0) return chosen;
  const Eigen::MatrixXd others = chosen.rightCols(rest);
  chosen.rightCols(rest) = others * by_size(displaced * others, squares);
  return chosen;
}

}  // namespace

bool is_rigid(const Shape& shape, const model::Coordinates& q) {
  if (shape.real.size() == 1) return true;
  const auto count = static_cast<Eigen::Index>(shape.real.size());
  Eigen::MatrixXd motions(3 * count, 6);
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(3 * count, 2);  // real and imaginary part
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto node = static_cast<std::size_t>(i);
    motions.middleRows<3>(3 * i).leftCols<3>().setIdentity();
    motions.middleRows<3>(3 * i).rightCols<3>() =
        -skew(model::NodeTable::slots(q, static_cast<int>(i)).col(0));
    moved.col(0).segment<3>(3 * i) = shape.real[node].head<3>();
    if (!shape.imaginary.empty()) {
      moved.col(1).segment<3>(3 * i) = shape.imaginary[node].head<3>();
    }
  }
  const Eigen::MatrixXd fitted = motions * motions.colPivHouseholderQr().solve(moved);
  return (moved - fitted).norm() < 1e-3 * moved.norm();
}

Eigen::MatrixXd combine_zero_modes(const std::vector<std::vector<Vec6>>& shapes,
                                   const model::Model& model, const model::State& state) {
  const auto count = static_cast<Eigen::Index>(shapes.size());
  const Eigen::Index nodes = model.nodes().size();
  Eigen::MatrixXd momentum(3, count), displaced(3 * nodes, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::vector<Vec6>& shape = shapes[static_cast<std::size_t>(k)];
    const model::Coordinates inertia = model.mass_times(slot_motions(model, state, shape));
    momentum.col(k).setZero();
    for (Eigen::Index node = 0; node < nodes; ++node) {
      momentum.col(k) += model::NodeTable::slots(inertia, static_cast<int>(node)).col(0);
      displaced.col(k).segment<3>(3 * node) = shape[static_cast<std::size_t>(node)].head<3>();
    }
  }
  return choose_combinations(momentum, displaced, model.mass());
}

}  // namespace culm::analysis
