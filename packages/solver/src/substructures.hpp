/// A matrix on several ranks, cut into what each rank can eliminate alone and what is left between
/// them.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include "block_rows.hpp"
#include "exchange.hpp"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace culm::solver {

/// Unknowns that meet one of a lower rank are the interface, and those of this rank that meet one
/// node of it and nothing else; all others are interior, and those of two ranks never meet. So each
/// rank eliminates its interior alone, and what that leaves of the interface,
///
///     S = A_BB - sum over ranks of A_BI A_II^-1 A_IB,
///
/// is a small matrix on the root. The plan is made once, because the pattern never changes; it must
/// be symmetric. @source J. S. Przemieniecki, Matrix structural analysis of substructures, 1963
class Substructures {
 public:
  /// @param widest  unknowns of the interface; if there are more, that is all there is to know
  Substructures(Teuchos::RCP<const assembly::CrsMatrix> matrix, const parallel::Comm& comm,
                int widest = std::numeric_limits<int>::max());
  Substructures(const Substructures&) = delete;
  Substructures& operator=(const Substructures&) = delete;

  /// [A_II A_IB; A_BI 0] of this rank, with the interface unknowns that its interior meets at the
  /// end. The rows of the interior are those of the matrix itself.
  BlockRows piece() const { return {*matrix_, piece_}; }
  /// Unknowns at its end that are of the interface.
  int kept() const { return static_cast<int>(kept_.size()); }
  /// Unknowns of the interface; on all ranks.
  int interface_size() const { return interface_size_; }

  /// Brings the present values of A_BI to the pieces. Collective, as all that follows.
  void gather_values();
  /// Gathers what S is made of. @param remainder  of this rank, -A_BI A_II^-1 A_IB, row by row
  void gather_interface(std::span<const double> remainder);
  /// Calls visit(row, column, number) for it, always in the same order, on the root. What is at the
  /// same place adds up.
  template <class Visit>
  void for_interface(const Visit& visit) const {
    std::size_t number = 0;
    for (const Share& share : shares_) {
      for (int row : share.kept) {
        for (int column : share.kept) visit(row, column, number++);
      }
      for (const auto& [row, column] : share.entries) visit(row, column, number++);
    }
  }
  /// What was gathered last, by number; on the root.
  std::span<const double> of_interface() const { return of_interface_; }
  /// x = A^-1 b. @param piece  room for the unknowns of the piece @param interface  for those of
  /// the interface, on the root only @param reduce  eliminates the interior of a piece, whose
  /// unknowns are those of b (see `take`) @param solve_interface  on the root, S^-1 of its argument
  /// @param extend  finds the interior with the rest of the piece known
  template <class Reduce, class Solve, class Extend>
  void solve(std::span<const double> b, std::span<double> x, std::span<double> piece,
             std::span<double> interface, const Reduce& reduce, const Solve& solve_interface,
             const Extend& extend) {
    reduce(piece);
    if (interface_size_ > 0) {
      gather(b, piece, interface);
      if (comm_.is_root()) solve_interface(interface);
      scatter(interface, piece, x);
    }
    extend(piece);
    put(piece, x);
  }
  /// Of the matrix, from those of the pieces and, on the root, of S.
  Determinant join(Determinant piece, const std::optional<Determinant>& interface) const;
  /// For reports: into how many pieces the matrix was cut, and what is between them.
  std::string remark() const;
  /// The unknowns of the piece take part of a right-hand side: those of the interior theirs, the
  /// others zero.
  void take(std::span<const double> b, std::span<double> piece) const;

 private:
  // The right-hand side of S. @param piece  after the interior was eliminated @param whole on the
  // root only
  void gather(std::span<const double> b, std::span<const double> piece, std::span<double> whole);
  // The solution of S to the ends of the pieces and to the rows of the interface.
  void scatter(std::span<const double> whole, std::span<double> piece, std::span<double> x);
  // The interior to its rows.
  void put(std::span<const double> piece, std::span<double> x) const;
  // What a rank has of S.
  struct Share {
    std::vector<int> kept;                     // places of the unknowns that it kept
    std::vector<std::pair<int, int>> entries;  // of the matrix: rows and columns
  };

  template <class Visit>
  void for_entries(int row, const Visit& visit) const;
  std::size_t find_entry(long long row, long long column) const;
  std::vector<int> owners_of_columns() const;
  std::vector<bool> find_interface(const std::vector<int>& owners) const;
  void add_followers(std::span<double> is_interface) const;
  void find_rows(const std::vector<bool>& is_interface);
  void build_piece(const std::vector<int>& owners, const std::vector<bool>& is_interface);
  void build_interface(const std::vector<bool>& is_interface);

  Teuchos::RCP<const assembly::CrsMatrix> matrix_;
  assembly::CrsMatrix::local_matrix_host_type local_;  ///< of it; to ask for it allocates
  parallel::Comm comm_;
  std::vector<int> boundary_;    ///< rows of this rank that are of the interface
  std::vector<long long> kept_;  ///< global numbers
  int interface_size_ = 0;
  PartOfRows piece_;
  std::vector<std::pair<std::size_t, std::size_t>> values_here_;  ///< of the matrix, to the piece
  ByRank<int> values_out_;                     ///< values of the matrix that other ranks need
  ByRank<int> values_in_;                      ///< places in the piece of what they send
  std::vector<std::size_t> interface_values_;  ///< of the matrix, between unknowns of the interface
  std::vector<Share> shares_;                  ///< of each rank; on the root
  parallel::Funnel value_funnel_;
  std::vector<double> mine_of_interface_, of_interface_;
  parallel::Funnel row_funnel_;     ///< kept unknowns, then own rows of the interface
  std::vector<int> row_place_;      ///< of each gathered row in S; on the root
  std::vector<double> mine_, all_;  ///< what travels
};

}  // namespace culm::solver
