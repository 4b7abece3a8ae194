/// Who gave and took energy.
#pragma once

#include <culm/assembly/system.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace culm::analysis {

/// Sums the work of all batches of a system by the accounts that they name (`model::Booked`).
class Books {
 public:
  explicit Books(const assembly::System& system);

  /// Books an accepted step from state.prev to state.next; collective.
  /// @return the sum over all accounts
  model::StepWork add(const model::State& state, const Stencil& stencil);

  /// Names of the accounts, sorted.
  const std::vector<std::string>& accounts() const { return accounts_; }
  /// What was booked: by account, and last that of all batches without one.
  const std::vector<model::StepWork>& works() const { return works_; }
  std::vector<model::StepWork>& works() { return works_; }

 private:
  const assembly::System& system_;
  std::vector<model::Batch*> batches_;
  std::vector<std::string> accounts_;
  std::vector<std::size_t> account_of_;  ///< by batch
  std::vector<model::StepWork> works_;
};

}  // namespace culm::analysis
