#include <culm/math/fetch.hpp>
#include <culm/math/vector_units.hpp>
#include <culm/model/scatter.hpp>

#include <algorithm>

namespace culm::model {

void Target::clear(std::size_t end) {
  constexpr std::size_t least = 128;  // numbers, as of a node: memory asked for many at once waits
  const std::size_t from = stale_from;
  const std::size_t to = std::min(values.size(), std::max(end, from + least));
  std::fill(values.begin() + static_cast<std::ptrdiff_t>(from),
            values.begin() + static_cast<std::ptrdiff_t>(to), 0.0);
  stale_from = to < values.size() ? to : none;
  fetch_to_write(values.data() + to + numbers_ahead, (to - from) * sizeof(double));
}

void Scatter::add_item(std::span<const Rows> rows, std::span<const int> offsets) {
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  offsets_.insert(offsets_.end(), offsets.begin(), offsets.end());
  first_block_.push_back(rows_.size());
  first_pair_.push_back(offsets_.size());
}

template <int width>
CULM_FOR_EACH_VECTOR_UNIT void add_six_rows(const double* rows, const std::size_t* begin,
                                            double* values) {
  for (int i = 0; i < 6; ++i) {
    double* __restrict out = values + begin[i];
    for (int k = 0; k < width; ++k) out[k] += rows[i * width + k];
  }
}

template void add_six_rows<6>(const double*, const std::size_t*, double*);
template void add_six_rows<12>(const double*, const std::size_t*, double*);
template void add_six_rows<18>(const double*, const std::size_t*, double*);
template void add_six_rows<24>(const double*, const std::size_t*, double*);
template void add_six_rows<30>(const double*, const std::size_t*, double*);

}  // namespace culm::model
