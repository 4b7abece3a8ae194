#include "mumps_parts.hpp"

#include <culm/parallel/shared_failure.hpp>

#include <cmath>

namespace culm::solver {

using assembly::CrsMatrix;

namespace {

// A dense matrix and, on each rank, a share of it that travels, all on the root.
constexpr int widest_interface = 1200;

}  // namespace

MumpsParts::MumpsParts(const Teuchos::RCP<const CrsMatrix>& matrix, const parallel::Comm& comm)
    : comm_(comm), parts_(matrix, comm, widest_interface) {
  if (parts_.interface_size() > widest_interface) return;
  order_ = order_rows(parts_.piece(), parts_.kept());
  const double interface = parts_.interface_size();
  operations_ = comm.max(order_.fill.operations) + 2.0 / 3.0 * std::pow(interface, 3);
  x_.resize(static_cast<std::size_t>(parts_.piece().size()));
  if (comm.is_root()) interface_x_.resize(static_cast<std::size_t>(parts_.interface_size()));
}

bool MumpsParts::factor(Symmetry symmetry) {
  parts_.gather_values();
  bool is_sound = false;
  parallel::together(comm_, [&] { is_sound = factor_piece(symmetry); });
  if (comm_.max(is_sound ? 0 : 1) != 0) return false;
  if (parts_.interface_size() == 0) return true;
  parts_.gather_interface(piece_ ? piece_->remainder() : std::span<const double>());
  if (comm_.is_root()) is_sound = factor_interface(symmetry);
  return comm_.max(is_sound ? 0 : 1) == 0;
}

bool MumpsParts::factor_piece(Symmetry symmetry) {
  if (x_.empty()) return true;
  if (!piece_ || piece_->symmetry() != symmetry) {
    piece_.reset();
    piece_.emplace(parts_.piece(), parts_.kept(), symmetry, order_.place);
  }
  return piece_->factor(parts_.piece());
}

bool MumpsParts::factor_interface(Symmetry symmetry) {
  const std::span<double> dense = interface_.start(parts_.interface_size());
  const std::span<const double> gathered = parts_.of_interface();
  parts_.for_interface([&](int row, int column, std::size_t number) {
    const auto place = static_cast<std::size_t>(row) * interface_x_.size();
    dense[place + static_cast<std::size_t>(column)] += gathered[number];
  });
  return interface_.factor(symmetry);
}

void MumpsParts::solve(const Vector& b, Vector& x) {
  const auto reduce = [&](std::span<double> piece) {
    parts_.take(b.values(), piece);
    if (piece_) piece_->reduce(piece);
  };
  const auto extend = [&](std::span<double> piece) {
    if (piece_) piece_->extend(piece);
  };
  parts_.solve(
      b.values(), x.values(), x_, interface_x_, reduce,
      [&](std::span<double> whole) { interface_.solve(whole); }, extend);
}

Determinant MumpsParts::determinant() const {
  constexpr Determinant of_nothing = {1, 0.0, 0};
  return parts_.join(piece_ ? piece_->determinant() : of_nothing,
                     interface_x_.empty() ? std::nullopt : std::optional(interface_.determinant()));
}

}  // namespace culm::solver
