/// Values of the unknowns that other ranks own.
#pragma once

#include <culm/assembly/column_values.hpp>
#include <culm/assembly/vector.hpp>

#include <memory>

namespace culm::assembly {

/// Completes vectors over rows to the columns of each rank.
class GhostImport {
 public:
  /// Collective. @pre the columns begin with the rows, as those of a Layout do
  GhostImport(const Rows& rows, const Rows& columns);
  ~GhostImport();

  /// Of all columns of this rank; valid as long as the vector and until the next call. Collective.
  ColumnValues operator()(const Vector& vector);

 private:
  struct Stored;

  Vector others_;
  std::unique_ptr<const Stored> stored_;
};

/// Whether the columns of this rank begin with its rows.
bool begin_with_rows(const Rows& rows, const Rows& columns);

}  // namespace culm::assembly
