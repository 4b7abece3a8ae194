#include <culm/analysis/analysis.hpp>

namespace culm::analysis {

void accept(model::State& state) {
  state.prev = state.next;
  state.multipliers_prev = state.multipliers;
  state.time_prev = state.time;
}

void reject(model::State& state) {
  state.next = state.prev;
  state.multipliers = state.multipliers_prev;
  state.time = state.time_prev;
}

}  // namespace culm::analysis
