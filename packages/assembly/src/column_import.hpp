/// Values of the unknowns that other ranks own.
#pragma once

#include <culm/assembly/tpetra.hpp>

namespace culm::assembly {

/// Brings a vector over rows to the columns of a rank.
class ColumnImport {
 public:
  ColumnImport(const Rows& rows, const Rows& columns)
      : values_(columns), import_(tpetra(rows), tpetra(columns)) {}

  /// Of all columns of this rank; valid until the next call. Collective.
  std::span<const double> operator()(const Vector& vector) {
    tpetra(values_).doImport(tpetra(vector), import_, Tpetra::INSERT);
    return values_.values();
  }

 private:
  Vector values_;
  Import import_;
};

}  // namespace culm::assembly
