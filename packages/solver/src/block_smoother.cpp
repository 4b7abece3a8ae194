#include "block_smoother.hpp"

#include <culm/math/types.hpp>
#include <culm/math/vector_units.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace culm::solver {

using assembly::Vector;

namespace {

// Eigenvalues below a share of the largest belong to the coarse grid.
struct Polynomial {
  int degree;
  double span;
};
// Least time for plates of 100 x 100 to 400 x 400, whose iterations are the fewest there, too;
// where elements have soft modes, it takes half as many iterations again, and as long.
constexpr Polynomial of_nodes{2, 10.0};
constexpr Polynomial with_modes{3, 20.0};
constexpr double margin = 1.1;  // of the largest eigenvalue, found from below
constexpr int lanczos_steps = 12;

// z = B r, with the columns of B one after the other.
template <class Width>
[[gnu::always_inline]] inline void multiply_columns(const float* column, Width width,
                                                    const double* r, double* z) {
  for (int i = 0; i < width; ++i) z[i] = 0.0;
  for (int k = 0; k < width; ++k, column += width) {
    for (int i = 0; i < width; ++i) z[i] += static_cast<double>(column[i]) * r[k];
  }
}

CULM_FOR_EACH_VECTOR_UNIT void multiply_block(const float* block, int width, const double* r,
                                              double* z) {
  if (width == 6) {
    double sums[6];
    multiply_columns(block, std::integral_constant<int, 6>(), r, sums);
    std::copy_n(sums, 6, z);
  } else {
    multiply_columns(block, width, r, z);
  }
}

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
  matrix_.copy(grid_.rows());
  for (int node = 0; node < grid_.nodes(); ++node) {
    const int width = grid_.width(node);
    const auto columns = grid_.rows().columns(node);
    const auto invert = [&](auto block) {
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const int place = columns[k] - grid_.first_column(node);
        if (place < 0 || place >= width) continue;
        for (int row = 0; row < width; ++row) {
          block(row, place) = grid_.rows().values(node)[index(row) * columns.size() + k];
        }
      }
      Eigen::Map<Eigen::MatrixXf> inverse(inverse_.data() + first_[index(node)], width, width);
      const Eigen::FullPivLU<decltype(block)> lu(block);
      leaves_[index(node)] = !lu.isInvertible() || !block.allFinite();
      if (leaves_[index(node)]) {
        inverse.setZero();
      } else {
        inverse = lu.inverse().eval().template cast<float>();
      }
    };
    if (width == 6) {
      invert(Mat6());
    } else {
      invert(Eigen::MatrixXd(width, width));
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
    multiply_block(inverse(node), width, from.data() + first, to.data() + first);
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
  x.fill(0.0);
  improve(b, x);
}

void BlockSmoother::smooth_further(const Vector& b, Vector& x) {
  grid_.subtract_product(matrix_, x, b, rest_);
  improve(rest_, x);
}

// `rest_` becomes b - A x before the last step. @param rest  b - A x, may be `rest_`
void BlockSmoother::improve(const Vector& rest, Vector& x) {
  const auto [degree, span] = modes_ ? with_modes : of_nodes;
  const double upper = margin * upper_;
  const double lower = upper / span;
  const double centre = 0.5 * (upper + lower);
  const double radius = 0.5 * (upper - lower);
  const double sigma = centre / radius;
  double rho = 1.0 / sigma;
  precondition(rest, product_);
  advance(1.0 / centre, 0.0, x);
  for (int k = 1; k < degree; ++k) {
    grid_.subtract_product(matrix_, step_, k == 1 ? rest : rest_, rest_);
    precondition(rest_, product_);
    const double next = 1.0 / (2.0 * sigma - rho);
    advance(2.0 * next / radius, next * rho, x);
    rho = next;
  }
}

// A new step, from the product and from the step before unless that has no part.
void BlockSmoother::advance(double of_product, double of_step, Vector& x) {
  const auto product = std::as_const(product_).values();
  const auto step = step_.values();
  const auto to = x.values();
  for (std::size_t i = 0; i < step.size(); ++i) {
    step[i] = of_product * product[i] + (of_step == 0.0 ? 0.0 : of_step * step[i]);
    to[i] += step[i];
  }
}

const Vector& BlockSmoother::find_rest() {
  grid_.subtract_product(matrix_, step_, rest_, rest_);
  return rest_;
}

}  // namespace culm::solver
