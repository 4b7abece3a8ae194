#include "whole_vector.hpp"

namespace culm::solver {

WholeVector::WholeVector(const assembly::Rows& rows, const parallel::Comm& comm)
    : comm_(comm), size_(static_cast<int>(rows.total())) {
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows_.push_back(static_cast<int>(rows.global(row)));
  }
}

void WholeVector::take(const Eigen::Ref<const Eigen::VectorXd>& whole,
                       std::span<double> piece) const {
  for (std::size_t row = 0; row < rows_.size(); ++row) piece[row] = whole[rows_[row]];
}

void WholeVector::join(std::span<const double> piece, Eigen::Ref<Eigen::VectorXd> whole) const {
  if (comm_.size() > 1) whole.setZero();
  for (std::size_t row = 0; row < rows_.size(); ++row) whole[rows_[row]] = piece[row];
  if (comm_.size() > 1) comm_.sum({whole.data(), static_cast<std::size_t>(size_)});
}

}  // namespace culm::solver
