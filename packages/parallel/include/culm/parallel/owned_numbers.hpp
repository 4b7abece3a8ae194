/// Numbers of items that each belong to one rank.
#pragma once

#include <culm/base/row_ranges.hpp>
#include <culm/parallel/comm.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace culm::parallel {

/// Brings the rows of a table that the ranks have together to rank 0. Collective.
/// @param own      the rows of this rank
/// @param numbers  row after row
/// @param all      the table, on rank 0; rows that nobody has stay as they are
inline void gather_rows(const Comm& comm, std::size_t width, const RowRanges& own,
                        std::span<const double> numbers, std::span<double> all) {
  std::vector<long long> ends;  // of the ranges of this rank
  for (const RowRange& range : own) {
    ends.push_back(static_cast<long long>(range.first));
    ends.push_back(static_cast<long long>(range.first + range.count));
  }
  ends = comm.gather(std::span<const long long>(ends));
  auto range = ends.begin();
  comm.gather(numbers, [&](int, std::span<const double> piece) {
    while (!piece.empty()) {
      const auto first = static_cast<std::size_t>(*range++);
      const std::size_t count = width * (static_cast<std::size_t>(*range++) - first);
      std::copy_n(piece.data(), count, all.data() + width * first);
      piece = piece.subspan(count);
    }
  });
}

/// The same as a new table; empty on other ranks. @param rows  of the table
inline std::vector<double> gather_rows(const Comm& comm, std::size_t rows, std::size_t width,
                                       const RowRanges& own, std::vector<double> numbers) {
  if (comm.size() == 1 && numbers.size() == rows * width) return numbers;
  std::vector<double> all(comm.is_root() ? rows * width : 0);
  gather_rows(comm, width, own, numbers, all);
  return all;
}

/// `width` numbers of each of `count` items, one after the other, on rank 0; empty elsewhere.
/// Collective.
/// @param owns(item)             true on one rank; on none, and its numbers are zero
/// @param append(item, numbers)  called there
template <class Owns, class Append>
std::vector<double> gather_owned(const parallel::Comm& comm, std::size_t count, std::size_t width,
                                 const Owns& owns, const Append& append) {
  RowRanges own;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const int item = static_cast<int>(i);
    if (!owns(item)) continue;
    append_row(own, i);
    append(item, numbers);
  }
  return gather_rows(comm, count, width, own, std::move(numbers));
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
