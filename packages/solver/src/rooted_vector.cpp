#include "rooted_vector.hpp"

#include <algorithm>

namespace culm::solver {

using assembly::values_of;
using assembly::Vector;

RootedVector::RootedVector(const assembly::Map& map, const parallel::Comm& comm)
    : alone_(comm.size() == 1) {
  if (alone_) return;
  std::vector<long long> rows(map.getNodeNumElements());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r] = map.getGlobalElement(static_cast<int>(r));
  }
  funnel_ = parallel::Funnel(comm, static_cast<int>(rows.size()));
  const auto all = comm.gather(std::span<const long long>(rows));
  place_.assign(all.begin(), all.end());
  gathered_.resize(all.size());
}

void RootedVector::gather(const Vector& piece, std::span<double> whole) {
  const auto values = values_of(piece);
  if (alone_) {
    std::copy(values.begin(), values.end(), whole.begin());
    return;
  }
  funnel_.gather(values, gathered_);
  for (std::size_t g = 0; g < place_.size(); ++g) whole[place_[g]] = gathered_[g];
}

void RootedVector::scatter(std::span<const double> whole, Vector& piece) {
  const auto values = values_of(piece);
  if (alone_) {
    std::copy(whole.begin(), whole.end(), values.begin());
    return;
  }
  for (std::size_t g = 0; g < place_.size(); ++g) gathered_[g] = whole[place_[g]];
  funnel_.scatter(gathered_, values);
}

}  // namespace culm::solver
