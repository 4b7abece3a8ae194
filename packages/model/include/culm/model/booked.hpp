/// Accounts of the energy balance.
#pragma once

#include <string>
#include <utility>

namespace culm::model {

/// A batch whose work has a line of its own in the energy balance, such as that of the air. What
/// several batches book under one name is summed.
class Booked {
 public:
  virtual ~Booked() = default;

  /// Name of the account; none if empty.
  const std::string& account() const { return account_; }
  /// Before the first step.
  void book_under(std::string account) { account_ = std::move(account); }

 protected:
  explicit Booked(std::string account = {}) : account_(std::move(account)) {}

 private:
  std::string account_;
};

}  // namespace culm::model
