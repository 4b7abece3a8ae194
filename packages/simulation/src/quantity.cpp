#include <culm/simulation/quantity.hpp>

#include <algorithm>
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

std::optional<std::vector<int>> nodes_of(const std::vector<WatchedQuantity>& watched) {
  std::vector<int> all;
  for (const WatchedQuantity& one : watched) {
    const auto nodes = one.quantity->nodes();
    if (!nodes) return {};
    all.insert(all.end(), nodes->begin(), nodes->end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<double> evaluate(const std::vector<WatchedQuantity>& watched,
                             const assembly::System& system, const model::State& state) {
  std::vector<double> numbers;
  for (const WatchedQuantity& one : watched) one.quantity->evaluate(system, state, numbers);
  return numbers;
}

std::vector<std::string> doubts_of(const std::vector<WatchedQuantity>& watched) {
  std::vector<std::string> doubts;
  for (const WatchedQuantity& one : watched) {
    const std::string doubt = one.quantity->doubt();
    if (!doubt.empty()) doubts.push_back("'" + one.name + "' " + doubt);
  }
  return doubts;
}

}  // namespace culm::simulation
