/// Numbers of items that each belong to one rank.
#pragma once

#include <culm/parallel/comm.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace culm::parallel {

/// `width` numbers of each of `count` items, one after the other, on rank 0; empty elsewhere.
/// Collective.
/// @param owns(item)             true on one rank; on none, and its numbers are zero
/// @param append(item, numbers)  called there
template <class Owns, class Append>
std::vector<double> gather_owned(const parallel::Comm& comm, std::size_t count, std::size_t width,
                                 const Owns& owns, const Append& append) {
  std::vector<int> items;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const int item = static_cast<int>(i);
    if (!owns(item)) continue;
    items.push_back(item);
    append(item, numbers);
  }
  if (comm.size() == 1 && items.size() == count) return numbers;
  items = comm.gather(std::span<const int>(items));
  std::vector<double> all(comm.is_root() ? count * width : 0);
  auto item = items.begin();
  comm.gather(numbers, [&](int, std::span<const double> piece) {
    for (std::size_t from = 0; from < piece.size(); from += width) {
      const std::size_t to = width * static_cast<std::size_t>(*item++);
      std::copy_n(piece.data() + from, width, all.data() + to);
    }
  });
  return all;
}

/// The same on all ranks, of few items.
template <class Owns, class Append>
std::vector<double> share_owned(const parallel::Comm& comm, std::size_t count, std::size_t width,
                                const Owns& owns, const Append& append) {
  std::vector<double> all = gather_owned(comm, count, width, owns, append);
  all.resize(count * width);
  comm.broadcast(std::span<double>(all));
  return all;
}

}  // namespace culm::parallel
