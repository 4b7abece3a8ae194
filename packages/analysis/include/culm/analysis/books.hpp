/// Who gave and took energy.
#pragma once

#include <culm/assembly/system.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace culm::analysis {

/// Sums the work of all batches of a system by the accounts that they name (`model::Booked`).
class Books {
 public:
  /// @param with_momenta  whether forces and moments are asked for, or work alone
  Books(const assembly::System& system, bool with_momenta);

  /// Books an accepted step from state.prev to state.next; collective.
  /// @return the sum over all accounts
  model::StepWork add(const model::State& state, const Stencil& stencil);

  /// What all batches pushed with in the last step, whichever way: the sum of the sizes of their
  /// forces [N] and of their moments about the origin [N m], none less than on any number of ranks.
  /// Zero where they were not asked for.
  double forces() const { return pushed_[0]; }
  double moments() const { return pushed_[1]; }

  /// Names of the accounts, sorted.
  const std::vector<std::string>& accounts() const { return accounts_; }
  /// What was booked: by account, and last that of all batches without one.
  const std::vector<model::StepWork>& works() const { return works_; }
  std::vector<model::StepWork>& works() { return works_; }

 private:
  const assembly::System& system_;
  bool with_momenta_;
  std::vector<model::Batch*> batches_;  ///< that may have something to book
  std::vector<std::string> accounts_;
  std::vector<std::size_t> account_of_;  ///< by batch
  std::vector<model::StepWork> works_;
  std::vector<model::StepWork> step_;  ///< of the last step alone
  std::array<double, 2> pushed_ = {0.0, 0.0};
};

}  // namespace culm::analysis
