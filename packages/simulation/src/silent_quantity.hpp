/// A quantity of a load or constraint that does not act.
#pragma once

#include <culm/base/absent.hpp>
#include <culm/simulation/quantity.hpp>

namespace culm::simulation {

/// Stands for a watched quantity in analyses without its load or constraint: there is no value, so
/// it shows `absent`.
class SilentQuantity final : public Quantity {
 public:
  void set_columns(std::vector<output::HistoryColumn> columns) { columns_ = std::move(columns); }
  std::vector<output::HistoryColumn> columns() const override { return columns_; }
  void evaluate(const assembly::System&, const model::State&,
                std::vector<double>& numbers) const override {
    numbers.insert(numbers.end(), columns_.size(), absent);
  }

 private:
  std::vector<output::HistoryColumn> columns_;
};

}  // namespace culm::simulation
