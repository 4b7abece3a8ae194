#include "guarded_block_lu.hpp"

#include <fmt/format.h>

namespace culm::solver {

bool GuardedBlockLu::factor() {
  ++factorisations_;
  if (!uses_klu2_) return blocks_.factor() || factor_anew();
  ++by_klu2_;
  return uses_klu2_ = klu2_->factor();
}

bool GuardedBlockLu::factor_anew() {
  if (!uses_klu2_) ++by_klu2_;
  return uses_klu2_ = klu2().factor_anew();
}

void GuardedBlockLu::solve(std::span<double> x) {
  if (uses_klu2_) {
    klu2_->solve(x);
  } else {
    blocks_.solve(x);
  }
}

Determinant GuardedBlockLu::determinant() const {
  return uses_klu2_ ? klu2_->determinant() : blocks_.determinant();
}

std::vector<int> GuardedBlockLu::pivots() const {
  return uses_klu2_ ? klu2_->pivots() : std::vector<int>{};
}

void GuardedBlockLu::remember_pivots() {
  used_klu2_ = uses_klu2_;
  if (klu2_) klu2_->remember_pivots();
}

void GuardedBlockLu::restore_pivots() {
  if (used_klu2_) klu2_->restore_pivots();
  uses_klu2_ = used_klu2_;
}

bool GuardedBlockLu::set_pivots(std::span<const int> pivots) {
  uses_klu2_ = !pivots.empty() && klu2().set_pivots(pivots);
  return uses_klu2_ == !pivots.empty();
}

std::string GuardedBlockLu::remark() const {
  if (by_klu2_ == 0) return {};
  return fmt::format("{} of {} factorisations by KLU2, where pivots inside blocks do not serve",
                     by_klu2_, factorisations_);
}

Klu2& GuardedBlockLu::klu2() {
  if (!klu2_) klu2_.emplace(matrix_);
  return *klu2_;
}

}  // namespace culm::solver
