/// The Tpetra types culm uses: double, int, long long, Kokkos Serial, by their default arguments.
#pragma once

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include <span>

namespace culm::assembly {

using Map = Tpetra::Map<>;
using Import = Tpetra::Import<>;
using CrsGraph = Tpetra::CrsGraph<>;
using CrsMatrix = Tpetra::CrsMatrix<>;
using Vector = Tpetra::Vector<>;
using GlobalIndex = Map::global_ordinal_type;

/// The values of a vector on this rank.
inline std::span<double> values_of(Vector& vector) {
  return {vector.getLocalViewHost(Tpetra::Access::ReadWrite).data(), vector.getLocalLength()};
}
inline std::span<const double> values_of(const Vector& vector) {
  return {vector.getLocalViewHost(Tpetra::Access::ReadOnly).data(), vector.getLocalLength()};
}

}  // namespace culm::assembly
