/// A quantity of a load or constraint that does not act.
#pragma once

#include <culm/simulation/quantity.hpp>

#include <limits>

namespace culm::simulation {

/// Stands for a watched quantity in analyses without its load or constraint: there is no value, so
/// it shows "not a number".
class SilentQuantity final : public Quantity {
 public:
  void set_columns(std::vector<output::HistoryColumn> columns) { columns_ = std::move(columns); }
  std::vector<output::HistoryColumn> columns() const override { return columns_; }
  void evaluate(const assembly::System&, const model::State&,
                std::vector<double>& numbers) const override {
    numbers.insert(numbers.end(), columns_.size(), std::numeric_limits<double>::quiet_NaN());
  }

 private:
  std::vector<output::HistoryColumn> columns_;
};

}  // namespace culm::simulation
