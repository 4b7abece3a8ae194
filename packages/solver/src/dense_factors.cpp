#include "dense_factors.hpp"

#include <culm/math/types.hpp>

#include <Teuchos_LAPACK.hpp>

#include <cmath>

// Teuchos::LAPACK does not have these.
extern "C" {
void dsytrf_(const char* uplo, const int* n, double* a, const int* lda, int* pivots, double* work,
             const int* size, int* info);
void dsytrs_(const char* uplo, const int* n, const int* columns, const double* a, const int* lda,
             const int* pivots, double* b, const int* ldb, int* info);
}

namespace culm::solver {
namespace {

constexpr char lower = 'L';
constexpr int widest_block = 64;  // for which there is room

// A pivot, or two that are eliminated together, by the determinant.
void add_pivots(double product, int negative, Determinant& determinant) {
  determinant.sign *= product < 0.0 ? -1 : 1;
  determinant.log_size += std::log(std::abs(product));
  if (determinant.negative) *determinant.negative += negative;
}

}  // namespace

std::span<double> DenseFactors::start(int size) {
  n_ = size;
  factors_.assign(column(n_), 0.0);
  pivots_.resize(index(n_));
  return factors_;
}

bool DenseFactors::factor(Symmetry symmetry) {
  symmetry_ = symmetry;
  int info = 0;
  if (symmetry == Symmetry::symmetric) {
    room_.resize(index(n_ * widest_block));
    const int size = static_cast<int>(room_.size());
    dsytrf_(&lower, &n_, factors_.data(), &n_, pivots_.data(), room_.data(), &size, &info);
  } else {
    Teuchos::LAPACK<int, double>().GETRF(n_, n_, factors_.data(), n_, pivots_.data(), &info);
  }
  return info == 0;
}

void DenseFactors::solve(std::span<double> b) const {
  constexpr int columns = 1;
  int info = 0;
  if (symmetry_ == Symmetry::symmetric) {
    dsytrs_(&lower, &n_, &columns, factors_.data(), &n_, pivots_.data(), b.data(), &n_, &info);
  } else {
    Teuchos::LAPACK<int, double>().GETRS('T', n_, columns, factors_.data(), n_, pivots_.data(),
                                         b.data(), n_, &info);
  }
}

Determinant DenseFactors::determinant() const {
  Determinant determinant{1, 0.0};
  const auto entry = [&](int row, int j) { return factors_[column(j) + index(row)]; };
  if (symmetry_ == Symmetry::none) {
    for (int k = 0; k < n_; ++k) {
      const bool is_exchanged = pivots_[index(k)] != k + 1;
      add_pivots(is_exchanged ? -entry(k, k) : entry(k, k), 0, determinant);
    }
    return determinant;
  }
  determinant.negative = 0;
  for (int k = 0; k < n_; ++k) {
    const double pivot = entry(k, k);
    if (pivots_[index(k)] > 0) {
      add_pivots(pivot, pivot < 0.0 ? 1 : 0, determinant);
      continue;
    }
    const double product = pivot * entry(k + 1, k + 1) - entry(k + 1, k) * entry(k + 1, k);
    const int both = pivot < 0.0 ? 2 : 0;
    add_pivots(product, product < 0.0 ? 1 : both, determinant);
    ++k;  // which belongs to this one
  }
  return determinant;
}

std::size_t DenseFactors::column(int j) const { return index(j) * index(n_); }

}  // namespace culm::solver
