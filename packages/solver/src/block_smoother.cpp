#include "block_smoother.hpp"

#include <culm/math/types.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>

namespace culm::solver {

using assembly::Vector;

namespace {

constexpr int degree = 3;
constexpr double span_of_eigenvalues = 20.0;  // what is below belongs to the coarse grid
constexpr double margin = 1.1;                // of the largest eigenvalue, found from below
constexpr int lanczos_steps = 12;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Entries without any symmetry, the same on any number of ranks.
void fill_irregular(Vector& v) {
  const auto values = v.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto global = static_cast<double>(v.rows().global(i));
    values[i] = std::fmod(0.6180339887498949 * (global + 1.0), 1.0) - 0.5;
  }
}

}  // namespace

BlockSmoother::BlockSmoother(const GridLevel& grid)
    : grid_(grid),
      rest_(assembly::rows_of(grid.matrix()->getRowMap())),
      step_(rest_.rows()),
      product_(rest_.rows()) {
  std::size_t at = 0;
  for (int node = 0; node < grid.nodes(); ++node) {
    first_.push_back(at);
    at += index(grid.width(node)) * index(grid.width(node));
  }
  inverse_.resize(at);
  leaves_.resize(index(grid.nodes()));
  refresh();
  largest_ = upper_ = find_largest();
}

void BlockSmoother::add_modes(const std::vector<bool>& carried, const parallel::Comm& comm) {
  modes_.emplace(grid_, carried, comm);
  if (modes_->count() == 0) {
    modes_.reset();
  } else {
    upper_ = find_largest();
  }
}

void BlockSmoother::refresh() {
  grid_.rows().round(rounded_);
  for (int node = 0; node < grid_.nodes(); ++node) {
    const int width = grid_.width(node);
    const auto columns = grid_.rows().columns(node);
    RowMajor block(width, width);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const int place = columns[k] - grid_.first_column(node);
      if (place < 0 || place >= width) continue;
      for (int row = 0; row < width; ++row) {
        block(row, place) = grid_.rows().values(node)[index(row) * columns.size() + k];
      }
    }
    Eigen::Map<RowMajor> inverse(inverse_.data() + first_[index(node)], width, width);
    const Eigen::FullPivLU<RowMajor> lu(block);
    leaves_[index(node)] = !lu.isInvertible() || !block.allFinite();
    if (leaves_[index(node)]) {
      inverse.setZero();
    } else {
      inverse = lu.inverse();
    }
  }
}

// z = M r
void BlockSmoother::precondition(const Vector& r, Vector& z) {
  const auto from = r.values();
  const auto to = z.values();
  for (int node = 0; node < grid_.nodes(); ++node) {
    const int width = grid_.width(node);
    const int first = grid_.first_column(node);
    if (width == 6) {
      Eigen::Map<Vec6>(to.data() + first).noalias() =
          Eigen::Map<const RowMat<6, 6>>(this->inverse(node)) *
          Eigen::Map<const Vec6>(from.data() + first);
      continue;
    }
    const Eigen::Map<const RowMajor> inverse(this->inverse(node), width, width);
    Eigen::Map<Eigen::VectorXd>(to.data() + first, width).noalias() =
        inverse * Eigen::Map<const Eigen::VectorXd>(from.data() + first, width);
  }
  if (modes_) modes_->add(r, z);
}

// Lanczos' method for M A in the inner product of M^-1, in the form of conjugate gradients.
double BlockSmoother::find_largest() {
  Vector z(rest_.rows()), direction(rest_.rows());
  fill_irregular(rest_);
  std::vector<double> alpha, beta;
  precondition(rest_, z);
  double size = rest_.dot(z);
  direction = z;
  while (size > 0.0 && alpha.size() < lanczos_steps) {
    grid_.multiply(direction, product_);
    const double energy = direction.dot(product_);
    if (!(energy > 0.0)) break;
    alpha.push_back(size / energy);
    rest_.update(-alpha.back(), product_);
    precondition(rest_, z);
    const double before = size;
    size = rest_.dot(z);
    beta.push_back(size / before);
    direction.update(1.0, z, beta.back());
  }
  const auto count = static_cast<Eigen::Index>(alpha.size());
  if (count == 0) return 1.0;
  Eigen::MatrixXd tridiagonal = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    tridiagonal(i, i) = 1.0 / alpha[k] + (i > 0 ? beta[k - 1] / alpha[k - 1] : 0.0);
    if (i > 0) {
      tridiagonal(i, i - 1) = tridiagonal(i - 1, i) =
          std::sqrt(std::abs(beta[k - 1])) / alpha[k - 1];
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tridiagonal, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

void BlockSmoother::smooth(const Vector& b, Vector& x) {
  const double upper = margin * upper_;
  const double lower = upper / span_of_eigenvalues;
  const double centre = 0.5 * (upper + lower);
  const double radius = 0.5 * (upper - lower);
  const double sigma = centre / radius;
  double rho = 1.0 / sigma;
  rest_ = b;
  precondition(rest_, step_);
  step_.scale(1.0 / centre);
  x = step_;
  for (int k = 1; k < degree; ++k) {
    find_rest();
    precondition(rest_, product_);
    const double next = 1.0 / (2.0 * sigma - rho);
    step_.update(2.0 * next / radius, product_, next * rho);
    x.update(1.0, step_);
    rho = next;
  }
}

const Vector& BlockSmoother::find_rest() {
  grid_.multiply(rounded_, step_, product_);
  rest_.update(-1.0, product_);
  return rest_;
}

}  // namespace culm::solver
