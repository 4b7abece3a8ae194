#include "sparse_interface.hpp"

#include <culm/math/types.hpp>

#include "serial_rows.hpp"

#include <algorithm>

namespace culm::solver {

SparseInterface::SparseInterface(const Substructures& parts) {
  Lists lists(index(parts.interface_size()));
  std::size_t count = 0;
  parts.for_interface([&](int row, int column, std::size_t number) {
    lists[index(row)].push_back({column, number});
    ++count;
  });
  place_.resize(count);
  SerialRows rows;
  for (std::vector<Entry>& row : lists) {
    rows.add(row, [&](std::size_t number, std::size_t place) { place_[number] = place; });
  }
  matrix_ = rows.make_matrix();
}

void SparseInterface::fill(const Substructures& parts) {
  const auto values = matrix_->getLocalMatrixHost().values;
  std::fill_n(values.data(), values.extent(0), 0.0);
  for (std::size_t k = 0; k < place_.size(); ++k) values(place_[k]) += parts.of_interface()[k];
}

}  // namespace culm::solver
