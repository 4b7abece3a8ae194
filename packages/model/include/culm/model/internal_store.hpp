/// Memory of laws that have unknowns of their own.
#pragma once

#include <culm/mechanics/internal_variables.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace culm::model {

/// Internal variables of all points of a batch: of the last accepted step, and of the last
/// evaluation. A batch is not told whether a step was accepted; it is, if the next one starts from
/// the very strain of the last evaluation.
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
  /// At the start of a step from the strain y of a point.
  void begin_step(std::size_t point, const Strain& y) {
    if (y == strain_[point]) {
      prev_[point] = next_[point];
    } else {
      next_[point] = prev_[point];  // the last attempt was given up
    }
  }
  const Internals& prev(std::size_t point) const { return prev_[point]; }
  /// First guess and solution of an evaluation at the strain y.
  Internals& solve_at(std::size_t point, const Strain& y) {
    strain_[point] = y;
    return next_[point];
  }
  /// Those that belong to a strain at one of the ends of the step.
  const Internals& at(std::size_t point, const Strain& y) const {
    return y == strain_[point] ? next_[point] : prev_[point];
  }

  /// Numbers that a point keeps, for checkpoints.
  static constexpr std::size_t point_memory = 2 * E::num_internals + E::num_strains;
  void save(std::size_t point, std::span<double> memory) const {
    std::copy_n(prev_[point].data(), E::num_internals, memory.data());
    std::copy_n(next_[point].data(), E::num_internals, memory.data() + E::num_internals);
    std::copy_n(strain_[point].data(), E::num_strains, memory.data() + 2 * E::num_internals);
  }
  void restore(std::size_t point, std::span<const double> memory) {
    std::copy_n(memory.data(), E::num_internals, prev_[point].data());
    std::copy_n(memory.data() + E::num_internals, E::num_internals, next_[point].data());
    std::copy_n(memory.data() + 2 * E::num_internals, E::num_strains, strain_[point].data());
  }

 private:
  std::vector<Internals> prev_, next_;
  std::vector<Strain> strain_;  ///< of the last evaluation
};

}  // namespace culm::model
