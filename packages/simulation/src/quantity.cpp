#include <culm/simulation/quantity.hpp>

#include <utility>

namespace culm::simulation {

std::vector<output::HistoryColumn> columns_of(const std::vector<WatchedQuantity>& watched) {
  std::vector<output::HistoryColumn> all;
  for (const WatchedQuantity& one : watched) {
    for (output::HistoryColumn column : one.quantity->columns()) {
      column.name = column.name.empty() ? one.name : one.name + " " + column.name;
      all.push_back(std::move(column));
    }
  }
  return all;
}

std::vector<double> evaluate(const std::vector<WatchedQuantity>& watched,
                             const assembly::System& system, const model::State& state) {
  std::vector<double> numbers;
  for (const WatchedQuantity& one : watched) one.quantity->evaluate(system, state, numbers);
  return numbers;
}

}  // namespace culm::simulation
