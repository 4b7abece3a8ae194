/// The nodes of a matrix, here and beside.
#pragma once

#include <culm/assembly/node_motions.hpp>
#include <culm/parallel/comm.hpp>

#include "grouped_matrix.hpp"

#include <optional>
#include <span>
#include <vector>

namespace culm::solver {

/// A row for each unknown: how rigid motions of the whole move it.
using NearNullSpace = assembly::NodeMotions::Rigid;

/// A matrix by nodes: groups of unknowns that stand together, in columns as in rows. Columns of
/// this rank come first, in the order of the rows.
class GridLevel {
 public:
  /// @param matrix its row map gives the rows, its column map those and the ones beside
  /// @param widths unknowns of each node of this rank. Collective.
  GridLevel(Teuchos::RCP<const assembly::CrsMatrix> matrix, const std::vector<int>& widths,
            NearNullSpace rigid, const parallel::Comm& comm);

  const Teuchos::RCP<const assembly::CrsMatrix>& matrix() const { return matrix_; }
  const GroupedMatrix& rows() const { return rows_; }
  const NearNullSpace& rigid() const { return rigid_; }
  /// Nodes of this rank; their numbers are the lowest.
  int nodes() const { return rows_.groups(); }
  /// Those and the ones beside.
  int all_nodes() const { return static_cast<int>(first_column_.size()) - 1; }
  int first_column(int node) const { return first_column_[static_cast<std::size_t>(node)]; }
  int width(int node) const { return first_column(node + 1) - first_column(node); }
  /// Node of a local column.
  int node_of(int column) const { return node_of_[static_cast<std::size_t>(column)]; }
  /// Numbers of the nodes beside, counted rank after rank.
  const std::vector<long long>& beside() const { return beside_; }
  /// Where the nodes of each rank begin, and the end.
  const std::vector<long long>& begin() const { return begin_; }

  /// Marks of all nodes, from those of the nodes of each rank. Collective.
  std::vector<bool> share(const std::vector<bool>& marks) const;
  /// y = A x; collective.
  void multiply(const assembly::Vector& x, assembly::Vector& y) const;
  /// y = b - A x, by a rounded copy of `rows`; collective. @param b  may be y
  void subtract_product(const RoundedMatrix& rounded, const assembly::Vector& x,
                        const assembly::Vector& b, assembly::Vector& y) const;

 private:
  std::span<const double> of_all_columns(const assembly::Vector& x) const;

  Teuchos::RCP<const assembly::CrsMatrix> matrix_;
  GroupedMatrix rows_;
  NearNullSpace rigid_;
  std::vector<int> first_column_;
  std::vector<int> node_of_;
  std::vector<long long> beside_;
  std::vector<long long> begin_;
  mutable std::optional<assembly::Vector> columns_;  ///< room of a product; on several ranks
};

}  // namespace culm::solver
