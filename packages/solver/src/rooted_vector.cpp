#include "rooted_vector.hpp"

#include <algorithm>

namespace culm::solver {

RootedVector::RootedVector(const assembly::Rows& rows, const parallel::Comm& comm)
    : alone_(comm.size() == 1) {
  if (alone_) return;
  std::vector<long long> numbers(rows.size());
  for (std::size_t r = 0; r < numbers.size(); ++r) numbers[r] = rows.global(r);
  funnel_ = parallel::Funnel(comm, static_cast<int>(numbers.size()));
  const auto all = comm.gather(std::span<const long long>(numbers));
  place_.assign(all.begin(), all.end());
  gathered_.resize(all.size());
}

void RootedVector::gather(std::span<const double> piece, std::span<double> whole) {
  if (alone_) {
    std::ranges::copy(piece, whole.begin());
    return;
  }
  funnel_.gather(piece, gathered_);
  for (std::size_t g = 0; g < place_.size(); ++g) whole[place_[g]] = gathered_[g];
}

void RootedVector::scatter(std::span<const double> whole, std::span<double> piece) {
  if (alone_) {
    std::ranges::copy(whole, piece.begin());
    return;
  }
  for (std::size_t g = 0; g < place_.size(); ++g) gathered_[g] = whole[place_[g]];
  funnel_.scatter(gathered_, piece);
}

}  // namespace culm::solver
