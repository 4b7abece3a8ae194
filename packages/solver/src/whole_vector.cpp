#include "whole_vector.hpp"

namespace culm::solver {

using assembly::values_of;

WholeVector::WholeVector(const assembly::Map& map, const parallel::Comm& comm)
    : comm_(comm), size_(static_cast<int>(map.getGlobalNumElements())) {
  for (std::size_t row = 0; row < map.getNodeNumElements(); ++row) {
    rows_.push_back(static_cast<int>(map.getGlobalElement(static_cast<int>(row))));
  }
}

void WholeVector::take(const Eigen::Ref<const Eigen::VectorXd>& whole,
                       assembly::Vector& piece) const {
  const auto values = values_of(piece);
  for (std::size_t row = 0; row < rows_.size(); ++row) values[row] = whole[rows_[row]];
}

void WholeVector::join(const assembly::Vector& piece, Eigen::Ref<Eigen::VectorXd> whole) const {
  const auto values = values_of(piece);
  if (comm_.size() > 1) whole.setZero();
  for (std::size_t row = 0; row < rows_.size(); ++row) whole[rows_[row]] = values[row];
  if (comm_.size() > 1) comm_.sum({whole.data(), static_cast<std::size_t>(size_)});
}

}  // namespace culm::solver
