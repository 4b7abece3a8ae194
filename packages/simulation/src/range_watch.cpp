#include "range_watch.hpp"

#include <algorithm>

namespace culm::simulation {

void RangeWatch::begin(const model::Model& model) {
  loads_.clear();
  for (const auto& load : model.loads()) {
    const auto* method = dynamic_cast<const model::LimitedRange*>(load.get());
    if (method != nullptr) loads_.push_back({method});
  }
}

void RangeWatch::step(const assembly::System& system) {
  for (Load& load : loads_) {
    load.used = std::max(load.used, system.comm().max(load.method->range_used()));
  }
}

void RangeWatch::report(double time, Findings& findings) const {
  for (const Load& load : loads_) {
    if (load.used > 1.0) findings.warn("range", load.method->range_warning(load.used), time);
  }
}

void RangeWatch::save(Snapshot& snapshot) const {
  std::vector<double> used;
  for (const Load& load : loads_) used.push_back(load.used);
  snapshot.set("run/ranges", std::move(used));
}

void RangeWatch::restore(const Snapshot& snapshot) {
  const std::span<const double> used = snapshot.numbers("run/ranges", loads_.size());
  for (std::size_t i = 0; i < loads_.size(); ++i) loads_[i].used = used[i];
}

}  // namespace culm::simulation
