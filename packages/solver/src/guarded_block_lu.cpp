#include "guarded_block_lu.hpp"

#include <fmt/format.h>

#include <utility>

namespace culm::solver {
namespace {

constexpr int hosts_follow = -1;  // no pivot of KLU2

}  // namespace

bool GuardedBlockLu::factor() {
  return factor_with([&] { return blocks_.factor(); });
}

bool GuardedBlockLu::factor_for(std::span<const double> b) {
  return factor_with([&] { return has_begun_ = blocks_.factor_and_reduce(b); });
}

template <class FactorBlocks>
bool GuardedBlockLu::factor_with(const FactorBlocks& factor_blocks) {
  has_begun_ = false;
  ++factorisations_;
  if (uses_klu2_) return factor_by_klu2(false);
  const bool is_first = blocks_.hosts().empty();
  if (is_first) remember_once();
  if (factor_blocks()) return true;
  return (!is_first && factor_with_other_hosts()) || factor_by_klu2(true);
}

bool GuardedBlockLu::factor_with_other_hosts() {
  const std::vector<int> before = pivots();
  const std::vector<int> hosts = blocks_.hosts();
  if (blocks_.factor_with_new_hosts()) {
    if (!remembered_) remembered_ = before;
    return true;
  }
  blocks_.set_hosts(hosts);
  return false;
}

bool GuardedBlockLu::factor_by_klu2(bool anew) {
  ++by_klu2_;
  const bool was_in_use = uses_klu2_;
  if (anew ? klu2().factor_anew() : klu2().factor()) {
    remember_once();
    uses_klu2_ = true;
    return true;
  }
  if (was_in_use) {
    klu2_->restore_pivots();
    uses_klu2_ = !klu2_->pivots().empty();
  }
  return false;
}

bool GuardedBlockLu::factor_anew() { return factor_by_klu2(true); }

void GuardedBlockLu::solve(std::span<double> x) {
  has_begun_ = false;  // blocks remember one right-hand side
  if (uses_klu2_) {
    klu2_->solve(x);
  } else {
    blocks_.solve(x);
  }
}

void GuardedBlockLu::finish(std::span<double> x) {
  if (std::exchange(has_begun_, false)) {
    blocks_.extend(x);
  } else {
    solve(x);
  }
}

Determinant GuardedBlockLu::determinant() const {
  return uses_klu2_ ? klu2_->determinant() : blocks_.determinant();
}

std::vector<int> GuardedBlockLu::pivots() const {
  if (uses_klu2_) return klu2_->pivots();
  std::vector<int> numbers;
  if (blocks_.hosts().empty()) return numbers;
  numbers.push_back(hosts_follow);
  numbers.insert(numbers.end(), blocks_.hosts().begin(), blocks_.hosts().end());
  return numbers;
}

// KLU2 itself remembers what it changes while it is in use.
void GuardedBlockLu::remember_once() {
  if (!uses_klu2_ && !remembered_) remembered_ = pivots();
}

void GuardedBlockLu::remember_pivots() {
  remembered_.reset();
  if (klu2_) klu2_->remember_pivots();
}

void GuardedBlockLu::restore_pivots() {
  if (remembered_) {
    const std::vector<int> pivots = std::move(*remembered_);
    set_pivots(pivots);
    remembered_.reset();
  } else if (uses_klu2_) {
    klu2_->restore_pivots();
  }
}

bool GuardedBlockLu::set_pivots(std::span<const int> pivots) {
  if (!remembered_) remembered_ = this->pivots();
  uses_klu2_ = false;
  if (pivots.empty()) return blocks_.set_hosts({});
  if (pivots.front() == hosts_follow) return blocks_.set_hosts(pivots.subspan(1));
  return uses_klu2_ = klu2().set_pivots(pivots);
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
