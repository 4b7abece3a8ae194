#include "klu2.hpp"

#include <culm/base/large_vector.hpp>

#include <Amesos2_KLU2_FunctionMap.hpp>

// The headers of KLU2 are meant to be included so. These two are not used by Amesos2 and do not
// work as they are: their functions are declared with other arguments, so they need names of their
// own, and no pointer can be deduced from NULL.
#undef KLU_refactor
#undef KLU_rgrowth
#define KLU_refactor factor_with_old_pivots
#define KLU_rgrowth find_pivot_growth
namespace KLU2 {
template <class Entry, class Int>
Int klu_scale(Int scale, Int n, Int* begin, Int* entries, Entry* values, double* factors,
              long /*null*/, klu_common<Entry, Int>* common) {
  return klu_scale<Entry, Int>(scale, n, begin, entries, values, factors,
                               static_cast<Int*>(nullptr), common);
}
#include <klu2_diagnostics.hpp>
#include <klu2_refactor.hpp>
}  // namespace KLU2

#include <algorithm>
#include <cmath>
#include <random>

namespace culm::solver {
namespace {

// With kept pivots a column of U may be so much larger than that of the matrix; the error of a
// solution grows by as much, and Newton's method bears far more.
constexpr double largest_growth = 1e4;

// 1 or -1 for an even or odd permutation
int parity(std::span<const int> permutation) {
  std::vector<bool> seen(permutation.size(), false);
  int sign = 1;
  for (std::size_t first = 0; first < permutation.size(); ++first) {
    // a cycle of k elements is k - 1 transpositions
    for (std::size_t k = first; !seen[k]; k = static_cast<std::size_t>(permutation[k])) {
      seen[k] = true;
      if (static_cast<std::size_t>(permutation[k]) != first) sign = -sign;
    }
  }
  return sign;
}

}  // namespace

// KLU2 stores by columns; rows of the matrix are columns to it, and it solves with the transpose.
struct Klu2::Parts {
  KLU2::klu_common<double, int> common;
  KLU2::klu_symbolic<double, int>* symbolic = nullptr;
  KLU2::klu_numeric<double, int>* numeric = nullptr;

  Parts() {
    KLU2::klu_defaults<double, int>(&common);
    common.scale = -1;  // Klu2::scale does it, in a tenth of the time
  }
  ~Parts() {
    free_factors();
    KLU2::klu_free_symbolic<double, int>(&symbolic, &common);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void free_factors() { KLU2::klu_free_numeric<double, int>(&numeric, &common); }
};

Klu2::Klu2(const assembly::CrsMatrix& matrix) : matrix_(matrix), parts_(std::make_unique<Parts>()) {
  const auto local = matrix.getLocalMatrixHost();
  const auto rows = static_cast<std::size_t>(local.numRows());
  for (std::size_t row = 0; row <= rows; ++row) {
    begin_.push_back(static_cast<int>(local.graph.row_map(row)));
  }
  entries_.assign(local.graph.entries.data(),
                  local.graph.entries.data() + local.graph.entries.extent(0));
  values_.resize(entries_.size());
  scale_.resize(rows);
  parts_->symbolic = KLU2::klu_analyze<double, int>(static_cast<int>(rows), begin_.data(),
                                                    entries_.data(), &parts_->common);
}

Klu2::~Klu2() = default;

bool Klu2::factor() {
  scale();
  return keep_pivots() || choose_pivots();
}

bool Klu2::factor_anew() {
  scale();
  return choose_pivots();
}

// Makes unknowns of different units comparable in the search for pivots.
void Klu2::scale() {
  const double* values = matrix_.getLocalMatrixHost().values.data();
  std::fill(scale_.begin(), scale_.end(), 0.0);
  for (std::size_t k = 0; k < values_.size(); ++k) {
    double& size = scale_[static_cast<std::size_t>(entries_[k])];
    size = std::max(size, std::abs(values[k]));
  }
  for (double& size : scale_) size = size > 0.0 ? 1.0 / size : 1.0;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    values_[k] = values[k] * scale_[static_cast<std::size_t>(entries_[k])];
  }
}

void Klu2::restore_pivots() {
  if (!remembered_) return;
  const std::vector<int> pivots = std::move(*remembered_);
  parts_->free_factors();
  if (!pivots.empty()) set_pivots(pivots);
  remembered_.reset();
}

bool Klu2::choose_pivots() {
  Parts& p = *parts_;
  if (!remembered_) remembered_ = pivots();
  kept_pivots_ = false;
  p.free_factors();
  // without an analysis the matrix is singular by its pattern
  if (p.symbolic == nullptr) return false;
  p.numeric = KLU2::klu_factor<double, int>(begin_.data(), entries_.data(), values_.data(),
                                            p.symbolic, &p.common);
  if (p.common.status == KLU_OUT_OF_MEMORY) fail_to_allocate();
  return p.numeric != nullptr;
}

// On failure the factors are of no use.
bool Klu2::keep_pivots() {
  Parts& p = *parts_;
  if (p.numeric == nullptr) return false;
  kept_pivots_ = true;
  if (KLU2::factor_with_old_pivots<double, int>(begin_.data(), entries_.data(), values_.data(),
                                                p.symbolic, p.numeric, &p.common) == 0) {
    return false;
  }
  KLU2::find_pivot_growth<double, int>(begin_.data(), entries_.data(), values_.data(), p.symbolic,
                                       p.numeric, &p.common);
  return largest_growth * p.common.rgrowth >= 1.0;
}

void Klu2::solve(std::span<double> x) {
  Parts& p = *parts_;
  KLU2::klu_tsolve<double, int>(p.symbolic, p.numeric, static_cast<int>(x.size()), 1, x.data(),
                                &p.common);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= scale_[i];
}

Determinant Klu2::determinant() const {
  const Parts& p = *parts_;
  const auto n = static_cast<std::size_t>(p.symbolic->n);
  Determinant d{parity({p.numeric->Pnum, n}) * parity({p.symbolic->Q, n}), 0.0};
  const auto* pivots = static_cast<const double*>(p.numeric->Udiag);
  for (std::size_t k = 0; k < n; ++k) {
    if (pivots[k] < 0.0) d.sign = -d.sign;
    d.log_size += std::log(std::abs(pivots[k])) - std::log(scale_[k]);
  }
  return d;
}

std::vector<int> Klu2::pivots() const {
  if (parts_->numeric == nullptr) return {};
  const int* first = parts_->numeric->Pnum;
  return {first, first + parts_->symbolic->n};
}

// Factors numbers that mean nothing, with the pivots on what KLU2 takes for the diagonal, and lets
// it prefer the diagonal to any larger entry. Order and pattern of the factors follow from that.
bool Klu2::set_pivots(std::span<const int> pivots) {
  Parts& p = *parts_;
  if (std::ranges::equal(this->pivots(), pivots)) return true;  // else it costs a factorisation
  if (pivots.empty()) {
    p.free_factors();
    return true;
  }
  std::vector<int> sorted(pivots.begin(), pivots.end());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (sorted[k] != static_cast<int>(k)) return false;
  }
  if (sorted.size() != scale_.size() || p.symbolic == nullptr) return false;
  // numbers that rise evenly would leave dense blocks without rank
  std::minstd_rand random;
  for (double& value : values_) value = 1e-9 * static_cast<double>(random());
  const std::vector<int> analysed(p.symbolic->P, p.symbolic->P + p.symbolic->n);
  const double tolerance = p.common.tol;
  std::copy(pivots.begin(), pivots.end(), p.symbolic->P);
  p.common.tol = 0.0;
  const bool done = choose_pivots();
  p.common.tol = tolerance;
  std::copy(analysed.begin(), analysed.end(), p.symbolic->P);
  return done && std::ranges::equal(this->pivots(), pivots);
}

}  // namespace culm::solver
