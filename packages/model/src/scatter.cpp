#include <culm/model/scatter.hpp>

namespace culm::model {

void Scatter::add_item(std::span<const Rows> rows, std::span<const int> offsets) {
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  offsets_.insert(offsets_.end(), offsets.begin(), offsets.end());
  first_block_.push_back(rows_.size());
  first_pair_.push_back(offsets_.size());
}

}  // namespace culm::model
