#include "distribution.hpp"

#include <algorithm>

namespace culm::water {

Distribution::Distribution(const Options& options, const std::string& one,
                           const std::string& several) {
  if (options.has(several)) {
    values_ = options.numbers(several);
    positions_ = options.numbers("Positions");
  } else {
    values_ = {options.has(one) ? options.number(one) : 0.0};
  }
}

double Distribution::at(double place, double middle) const {
  if (values_.size() == 1) return values_.front();
  const auto above = std::upper_bound(positions_.begin() + 1, positions_.end() - 1, middle);
  const auto i = static_cast<std::size_t>(above - positions_.begin());
  const double share = (place - positions_[i - 1]) / (positions_[i] - positions_[i - 1]);
  return values_[i - 1] + share * (values_[i] - values_[i - 1]);
}

}  // namespace culm::water
