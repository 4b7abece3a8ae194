#include "substructured_solver.hpp"

#include <culm/parallel/shared_failure.hpp>

#include "block_lu.hpp"
#include "guarded_block_lu.hpp"
#include "matrix_checks.hpp"
#include "residual_check.hpp"
#include "sparse_interface.hpp"
#include "substructures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;

constexpr int hosts_of_pieces_follow = -2;  // as first of the numbers that pivots() returns
constexpr int pivots_of_whole_follow = -3;

class SubstructuredSolver final : public LinearSolver {
 public:
  SubstructuredSolver(const Teuchos::RCP<const CrsMatrix>& matrix, const parallel::Comm& comm)
      : matrix_(matrix),
        comm_(comm),
        parts_(matrix, comm),
        piece_(parts_.piece(), parts_.kept()),
        x_(static_cast<std::size_t>(parts_.piece().size()), 0.0),
        check_(matrix, comm) {
    if (parts_.interface_size() > 0 && comm_.is_root()) {
      between_.emplace(parts_);
      interface_.emplace(between_->matrix());
      interface_x_.resize(between_->matrix().getNodeNumRows());
    }
  }

  std::string name() const override { return "Block LU"; }

  bool factor() override {
    has_begun_ = false;
    return factor_with([&] { return piece_.factor(); });
  }

  bool factor_for(const Vector& b) override {
    has_begun_ = false;
    return factor_with([&] {
      parts_.take(b.values(), x_);
      return has_begun_ = piece_.factor_and_reduce(x_);
    });
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    if (uses_whole_) return whole().solve(b, x);
    apply_inverse(b, x);
    double achieved = check_(b, x);
    if (achieved > largest_residual_of_doubtful_pivots) {
      const auto correct = [&] {
        if (!correction_) correction_.emplace(b.rows());
        check_.keep_rest(b, x);
        apply_inverse(check_.rest(), *correction_);
        x.update(1.0, *correction_);
      };
      achieved = refine(
          achieved, correct, [&] { return check_(b, x); }, [&] { x.update(-1.0, *correction_); });
    }
    if (achieved <= largest_residual_of_doubtful_pivots) return {achieved};
    return factor_whole() ? whole().solve(b, x) : LinearResidual{achieved};
  }

  Determinant determinant() override {
    if (uses_whole_) return whole().determinant();
    return parts_.join(piece_.determinant(),
                       interface_ ? std::optional(interface_->determinant()) : std::nullopt);
  }

  double weakest_direction(Vector& v) override {
    v.fill(0.0);
    const double size = comm_.max(largest_entry(*matrix_));
    if (!std::isfinite(size) || size == 0.0) return 0.0;
    SubstructuredSolver shifted(shifted_copy(*matrix_, relative_shift * size), comm_);
    if (!shifted.factor()) return 0.0;
    const auto solve = [&](const Vector& b, Vector& x) {
      if (shifted.uses_whole_) {
        shifted.whole().solve(b, x);
      } else {
        shifted.apply_inverse(b, x);
      }
    };
    return inverse_iteration(*matrix_, solve, v) / size;
  }

  void remember_pivots() override {
    remembered_.reset();
    if (interface_) interface_->remember_pivots();
    if (whole_) whole_->remember_pivots();
  }

  void restore_pivots() override {
    if (interface_) interface_->restore_pivots();
    if (whole_) whole_->restore_pivots();
    if (!remembered_) return;
    piece_.set_hosts(remembered_->hosts);
    all_hosts_ = std::move(remembered_->all_hosts);
    uses_whole_ = remembered_->uses_whole;
    remembered_.reset();
  }

  // The mark, the number of ranks, then the length and the hosts of each piece, then the pivots of
  // the interface; or the mark and the pivots of the whole.
  std::vector<int> pivots() const override {
    std::vector<int> numbers;
    const auto add = [&](const std::vector<int>& more) {
      numbers.insert(numbers.end(), more.begin(), more.end());
    };
    if (!comm_.is_root()) return numbers;
    if (uses_whole_) {
      numbers.push_back(pivots_of_whole_follow);
      add(whole_->pivots());
    } else if (!all_hosts_.empty()) {
      numbers.push_back(hosts_of_pieces_follow);
      numbers.push_back(comm_.size());
      add(all_hosts_);
      if (interface_) add(interface_->pivots());
    }
    return numbers;
  }

  bool set_pivots(std::span<const int> pivots) override {
    remember_once();
    uses_whole_ = false;
    const int kind = comm_.max(pivots.empty() ? 0 : std::max(1, -pivots.front()));
    if (kind == -pivots_of_whole_follow) {
      uses_whole_ = whole().set_pivots(pivots.empty() ? pivots : pivots.subspan(1));
      return uses_whole_;
    }
    const bool fit = kind == -hosts_of_pieces_follow && set_hosts(pivots);
    if (!fit) forget_hosts();
    return fit || kind == 0;
  }

  std::string remark() const override {
    std::string text = parts_.remark();
    if (by_whole_ > 0) {
      text += fmt::format("; {} of {} factorisations on one, where parts do not stand alone",
                          by_whole_, factorisations_);
    }
    return text;
  }

 private:
  // What depends on earlier factorisations.
  struct History {
    std::vector<int> hosts;
    std::vector<int> all_hosts;
    bool uses_whole = false;
  };

  void remember_once() {
    if (!remembered_) remembered_ = History{piece_.hosts(), all_hosts_, uses_whole_};
  }

  template <class FactorPiece>
  bool factor_with(const FactorPiece& factor_piece) {
    ++factorisations_;
    if (!uses_whole_ && factor_pieces(factor_piece)) return true;
    return factor_whole();
  }

  template <class FactorPiece>
  bool factor_pieces(const FactorPiece& factor_piece) {
    parts_.gather_values();
    const bool is_first = piece_.hosts().empty();
    if (is_first) remember_once();
    bool sound = false;
    parallel::together(comm_, [&] { sound = factor_piece(); });
    bool is_new = is_first;
    if (comm_.max(sound ? 0 : 1) != 0) {
      remember_once();  // on all ranks
      parallel::together(comm_, [&] {
        if (!sound && !is_first) sound = is_new = piece_.factor_with_new_hosts();
      });
      if (comm_.max(sound ? 0 : 1) != 0) {
        restore_hosts();
        return false;
      }
    }
    if (comm_.max(is_new ? 1 : 0) != 0) gather_hosts();
    if (parts_.interface_size() == 0) return true;
    parts_.gather_interface(piece_.remainder());
    if (between_) between_->fill(parts_);
    bool joins = true;
    parallel::together(comm_, [&] { joins = !interface_ || interface_->factor(); });
    return comm_.max(joins ? 0 : 1) == 0;
  }

  // Where a factorisation failed: the ones of a matrix that has none leave no trace.
  void restore_hosts() {
    piece_.set_hosts(remembered_->hosts);
    all_hosts_ = remembered_->all_hosts;
  }

  bool factor_whole() {
    ++by_whole_;
    const bool is_sound = whole().factor();
    if (is_sound || uses_whole_) remember_once();
    uses_whole_ = is_sound;
    return is_sound;
  }

  LinearSolver& whole() {
    if (!whole_) whole_ = make_rooted_block_lu(assembly::matrix_of(matrix_), comm_);
    return *whole_;
  }

  void apply_inverse(const Vector& b, Vector& x) {
    const auto reduce = [&](std::span<double> piece) {
      if (std::exchange(has_begun_, false)) return piece_.put_kept(piece);
      parts_.take(b.values(), piece);
      piece_.reduce(piece);
    };
    parts_.solve(
        b.values(), x.values(), x_, interface_x_, reduce,
        [&](std::span<double> whole) { interface_->solve(whole); },
        [&](std::span<double> piece) { piece_.extend(piece); });
  }

  void gather_hosts() {
    const std::vector<int>& hosts = piece_.hosts();
    std::vector<int> mine = {static_cast<int>(hosts.size())};
    mine.insert(mine.end(), hosts.begin(), hosts.end());
    all_hosts_ = comm_.gather(std::span<const int>(mine));
  }

  void forget_hosts() {
    piece_.set_hosts({});
    all_hosts_.clear();
    if (interface_) interface_->set_pivots({});
  }

  // Collective; of all ranks only the root has the numbers.
  bool set_hosts(std::span<const int> pivots) {
    std::vector<double> numbers(pivots.begin(), pivots.end());
    numbers.resize(static_cast<std::size_t>(comm_.max(static_cast<int>(pivots.size()))));
    comm_.broadcast(numbers);
    const auto left = [&](std::size_t at) { return numbers.size() - std::min(at, numbers.size()); };
    if (left(0) < 2 || numbers[1] != comm_.size()) return false;
    std::size_t at = 2;
    bool fit = true;
    for (int rank = 0; rank < comm_.size(); ++rank) {
      if (left(at) < 1 || numbers[at] < 0.0) return false;
      const auto count = static_cast<std::size_t>(numbers[at++]);
      if (left(at) < count) return false;
      if (rank == comm_.rank()) {
        const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(at);
        fit = piece_.set_hosts(std::vector<int>(first, first + static_cast<std::ptrdiff_t>(count)));
      }
      at += count;
    }
    if (interface_) fit = interface_->set_pivots(pivots.subspan(at)) && fit;
    if (comm_.max(fit ? 0 : 1) != 0) return false;
    gather_hosts();
    return true;
  }

  Teuchos::RCP<const CrsMatrix> matrix_;
  parallel::Comm comm_;
  Substructures parts_;
  BlockLu piece_;
  std::vector<double> x_;                    // of the piece
  bool has_begun_ = false;                   // the solution that follows
  std::optional<SparseInterface> between_;   // on the root, if there is an interface
  std::optional<GuardedBlockLu> interface_;  // on the root, if there is one
  std::vector<double> interface_x_;
  ResidualCheck check_;
  std::optional<Vector> correction_;     // where solutions are refined
  std::unique_ptr<LinearSolver> whole_;  // made when it is needed
  bool uses_whole_ = false;
  std::vector<int> all_hosts_;  // of all pieces; on the root
  std::optional<History> remembered_;
  long factorisations_ = 0;
  long by_whole_ = 0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_substructured(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm) {
  return std::make_unique<SubstructuredSolver>(assembly::tpetra(*matrix), comm);
}

}  // namespace culm::solver
