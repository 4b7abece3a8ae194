/// The Tpetra objects behind rows, vectors and matrices: double, int, long long, Kokkos Serial, by
/// their default arguments. For sources of assembly and solver; other packages need none of it.
#pragma once

#include <culm/assembly/matrix.hpp>

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include <memory>
#include <optional>
#include <span>

namespace culm::assembly {

class GhostImport;

using Map = Tpetra::Map<>;
using Import = Tpetra::Import<>;
using CrsGraph = Tpetra::CrsGraph<>;
using CrsMatrix = Tpetra::CrsMatrix<>;
using TpetraVector = Tpetra::Vector<>;
using GlobalIndex = Map::global_ordinal_type;

struct Rows::Stored {
  Teuchos::RCP<const Map> map;
};
struct Vector::Stored {
  TpetraVector vector;
};
struct Pattern::Stored {
  Teuchos::RCP<const CrsGraph> graph;
};
struct Matrix::Stored {
  explicit Stored(Teuchos::RCP<CrsMatrix> filled);
  ~Stored();
  Teuchos::RCP<CrsMatrix> matrix;  ///< fill is complete
  Rows rows, columns;
  /// For products; found when there is the first, null where Tpetra's own serves.
  std::optional<std::unique_ptr<GhostImport>> ghosts;
};

/// The ranks of a map; one alone does without MPI.
Teuchos::RCP<const Teuchos::Comm<int>> ranks_of(const parallel::Comm& comm);

inline const Teuchos::RCP<const Map>& tpetra(const Rows& rows) { return rows.stored().map; }
inline TpetraVector& tpetra(Vector& vector) { return vector.stored().vector; }
inline const TpetraVector& tpetra(const Vector& vector) { return vector.stored().vector; }
inline Teuchos::RCP<CrsMatrix> tpetra(Matrix& matrix) { return matrix.stored().matrix; }
inline Teuchos::RCP<const CrsMatrix> tpetra(const Matrix& matrix) { return matrix.stored().matrix; }
/// The rows of a map.
inline Rows rows_of(const Teuchos::RCP<const Map>& map) {
  return Rows(std::make_shared<const Rows::Stored>(map));
}

/// A vector or matrix that shares the values of Tpetra's.
inline Vector view_of(const TpetraVector& vector) {
  return Vector(std::make_unique<Vector::Stored>(TpetraVector(vector, Teuchos::View)));
}
inline std::shared_ptr<const Matrix> matrix_of(const Teuchos::RCP<const CrsMatrix>& matrix) {
  return std::make_shared<const Matrix>(
      std::make_unique<Matrix::Stored>(Teuchos::rcp_const_cast<CrsMatrix>(matrix)));
}

/// The values of a vector on this rank.
inline std::span<double> values_of(TpetraVector& vector) {
  return {vector.getLocalViewHost(Tpetra::Access::ReadWrite).data(), vector.getLocalLength()};
}
inline std::span<const double> values_of(const TpetraVector& vector) {
  return {vector.getLocalViewHost(Tpetra::Access::ReadOnly).data(), vector.getLocalLength()};
}

}  // namespace culm::assembly
