/// Values of the columns of a rank.
#pragma once

#include <cstddef>
#include <span>

namespace culm::assembly {

/// One for each column of this rank: those of its rows, which come first, and those of rows that
/// other ranks own. They do not stand side by side, so that nobody copies their own.
struct ColumnValues {
  std::span<const double> own, others;

  /// From a column to the last of its kind.
  std::span<const double> from(int column) const {
    const auto at = static_cast<std::size_t>(column);
    return at < own.size() ? own.subspan(at) : others.subspan(at - own.size());
  }
  double operator[](int column) const { return from(column).front(); }
};

}  // namespace culm::assembly
