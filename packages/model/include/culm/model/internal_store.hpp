/// Memory of laws that have unknowns of their own.
#pragma once

#include <culm/mechanics/internal_variables.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace culm::model {

/// Internal variables of all points of a batch: of the last accepted step, and of the last
/// evaluation.
template <ElementWithInternals E>
class InternalStore {
 public:
  using Internals = Vec<E::num_internals>;
  using Strain = Vec<E::num_strains>;

  void resize(std::size_t points) {
    prev_.assign(points, Internals::Zero());
    next_ = prev_;
    strain_.assign(points, Strain::Zero());
  }
  /// Before an attempt: the first guess is what was accepted.
  void prepare() { next_ = prev_; }
  /// After an attempt that is accepted.
  void accept() { prev_ = next_; }
  const Internals& prev(std::size_t point) const { return prev_[point]; }
  /// First guess and solution of an evaluation at the strain y.
  Internals& solve_at(std::size_t point, const Strain& y) {
    strain_[point] = y;
    return next_[point];
  }
  const Internals& next(std::size_t point) const { return next_[point]; }
  /// Those that belong to a strain at one of the ends of a step.
  const Internals& at(std::size_t point, const Strain& y) const {
    return y == strain_[point] ? next_[point] : prev_[point];
  }

  /// Numbers that a point keeps, for checkpoints.
  static constexpr std::size_t point_memory = E::num_internals;
  void save(std::size_t point, std::span<double> memory) const {
    std::copy_n(prev_[point].data(), E::num_internals, memory.data());
  }
  void restore(std::size_t point, std::span<const double> memory) {
    std::copy_n(memory.data(), E::num_internals, prev_[point].data());
    next_[point] = prev_[point];
  }

 private:
  std::vector<Internals> prev_, next_;
  std::vector<Strain> strain_;  ///< of the last evaluation
};

}  // namespace culm::model
