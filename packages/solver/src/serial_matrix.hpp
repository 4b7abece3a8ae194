/// Matrices that one rank has to itself.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <span>

namespace culm::solver {

/// A square matrix of zeros on this rank. @param begin  where the entries of each row begin, and
/// the end @param columns  of each entry, rising in each row
Teuchos::RCP<assembly::CrsMatrix> make_serial_matrix(std::span<const std::size_t> begin,
                                                     std::span<const int> columns);

}  // namespace culm::solver
