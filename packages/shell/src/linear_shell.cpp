#include <culm/mechanics/linear_law.hpp>
#include <culm/shell/linear_shell.hpp>

#include "shell_modes.hpp"

#include <Eigen/Geometry>

namespace culm::shell {

namespace {

constexpr int turn_and_slots = 3 + 3 * ShellForms::num_slots;

using Modes = ShellForms::Modes;

// Slot x or d of a node of the shell among all slots.
constexpr int place(int slot) { return 4 * (1 + slot / 2) + slot % 2; }

Mat3 frame(const LinearShell::Nodes& q) { return q.middleCols<3>(1); }

Modes modes(const LinearShell::Nodes& q) {
  ShellForms::Nodes shell;
  for (int s = 0; s < ShellForms::num_slots; ++s) shell.col(s) = q.col(place(s));
  return ShellForms::modes(shell);
}

// B X: rows of the turn of the frame, by δ(d_k . p_j) = ω . (d_k x p_j), then rows of the slots of
// the shell. All sums run along rows of X.
template <int Columns>
void apply_gradient(const Mat3& d, const Modes& p,
                    const RowMat<LinearShell::num_strains, Columns>& X,
                    RowMat<turn_and_slots, Columns>& BX) noexcept {
  RowMat<LinearShell::num_strains, Columns> by_modes;
  BX.template topRows<3>().setZero();
  for (int j = 0; j < ShellForms::num_modes; ++j) {
    for (int c = 0; c < 3; ++c) {
      by_modes.row(3 * j + c) =
          d(c, 0) * X.row(3 * j) + d(c, 1) * X.row(3 * j + 1) + d(c, 2) * X.row(3 * j + 2);
    }
    const Vec3 by_first = d.col(0).cross(p.col(j));
    const Vec3 by_second = d.col(1).cross(p.col(j));
    const Vec3 by_third = d.col(2).cross(p.col(j));
    for (int c = 0; c < 3; ++c) {
      BX.row(c) += by_first[c] * X.row(3 * j) + by_second[c] * X.row(3 * j + 1) +
                   by_third[c] * X.row(3 * j + 2);
    }
  }
  spread(by_modes, BX.template bottomRows<turn_and_slots - 3>());
}

}  // namespace

LinearShell::LinearShell(const ElasticShell& full, const Nodes& reference)
    : reference_(frame(reference).transpose() * modes(reference)),
      wall_(full.wall()),
      stiffness_(Stiffness::Zero()),
      mass_(full.mass()) {
  RowMat<ShellForms::num_strains, num_strains> T;
  for (int n = 0; n < num_strains; ++n) T.col(n) = products(Strain::Unit(n));
  const auto seen_from_frame = [&T](const ShellForms::Stiffness& C) {
    const Stiffness product = T.transpose() * C * T;
    return Symmetric<num_strains>(0.5 * (product + product.transpose()));
  };
  stiffness_ = seen_from_frame(full.stiffness(0));
  const std::size_t branches = wall_.layup->relaxation_times().size();
  for (std::size_t k = 0; k < branches; ++k) {
    branches_.push_back(seen_from_frame(full.branch_stiffness(0, k)));
  }
}

ShellForms::Strain LinearShell::products(const Strain& y) const noexcept {
  const Eigen::Map<const Modes> moved(y.data());
  ShellForms::Strain all;
  for (int i = 0; i < ShellForms::num_modes; ++i) {
    all[ShellForms::form(i, i)] = reference_.col(i).dot(moved.col(i));
    for (int j = i + 1; j < ShellForms::num_modes; ++j) {
      all[ShellForms::form(i, j)] =
          reference_.col(i).dot(moved.col(j)) + reference_.col(j).dot(moved.col(i));
    }
  }
  return all;
}

LinearShell::Strain LinearShell::seen_from_frame(const ShellForms::Strain& stress) const noexcept {
  Strain seen;
  for (int n = 0; n < num_strains; ++n) seen[n] = products(Strain::Unit(n)).dot(stress);
  return seen;
}

void LinearShell::strain(int, const Nodes& q, Strain& y) const noexcept {
  Eigen::Map<Modes>(y.data()) = frame(q).transpose() * modes(q) - reference_;
}

void LinearShell::gradient(int, const Nodes& q,
                           Gradient<num_slots, num_strains>& B) const noexcept {
  const Mat3 d = frame(q);
  const Modes p = modes(q);
  B.setZero();
  for (int j = 0; j < ShellForms::num_modes; ++j) {
    for (int k = 0; k < 3; ++k) {
      B.block<3, 1>(3 * (1 + k), 3 * j + k) = p.col(j);
      for (int s = 0; s < ShellForms::num_slots; ++s) {
        B.block<3, 1>(3 * place(s), 3 * j + k) = share(s, j) * d.col(k);
      }
    }
  }
}

void LinearShell::add_curvature(int, const Strain& S, SlotMatrix<num_slots>& A) const noexcept {
  for (int s = 0; s < ShellForms::num_slots; ++s) {
    Vec3 sum = Vec3::Zero();
    for (int j = s % 2 == 0 ? 0 : 3; j < (s % 2 == 0 ? 3 : ShellForms::num_modes); ++j) {
      sum += share(s, j) * S.segment<3>(3 * j);
    }
    A.block<3, 1>(1, place(s)) += sum;
    A.block<1, 3>(place(s), 1) += sum;
  }
}

void LinearShell::add_force(const Nodes& q, const Strain& S, Nodes& f) noexcept {
  const Eigen::Map<const Modes> stress(S.data());
  f.middleCols<3>(1) += modes(q) * stress.transpose();
  const Modes force = frame(q) * stress;
  for (int s = 0; s < ShellForms::num_slots; ++s) {
    for (int j = s % 2 == 0 ? 0 : 3; j < (s % 2 == 0 ? 3 : ShellForms::num_modes); ++j) {
      f.col(place(s)) += share(s, j) * force.col(j);
    }
  }
}

// As ShellForms::add_stiffness: twice along rows, transposed in between. The unknowns are in order
// but for dx of the frame, on which nothing depends.
void LinearShell::add_stiffness(const Nodes& mid, const Nodes& next, const Stiffness& C,
                                double factor, RowMat<6 * num_nodes, 6 * num_nodes>& K) noexcept {
  RowMat<turn_and_slots, LinearShell::num_strains> BC;
  apply_gradient<LinearShell::num_strains>(frame(mid), modes(mid), C, BC);
  const RowMat<LinearShell::num_strains, turn_and_slots> CB = BC.transpose();
  RowMat<turn_and_slots, turn_and_slots> transposed;
  apply_gradient<turn_and_slots>(frame(next), modes(next), CB, transposed);
  K.bottomRightCorner<turn_and_slots, turn_and_slots>() += factor * transposed.transpose();
}

Verdict LinearShell::respond(int, const Strain& prev, const Strain& next, const Stencil& stencil,
                             Response<num_strains>& response) const noexcept {
  LinearLaw<num_strains>{stiffness_.full()}.respond(prev, next, stencil, response);
  return Verdict::ok;
}

double LinearShell::energy(int, const Strain& y) const noexcept {
  return LinearLaw<num_strains>{stiffness_.full()}.energy(y);
}

SlotMatrix<LinearShell::num_slots> LinearShell::mass() const noexcept {
  SlotMatrix<num_slots> M = SlotMatrix<num_slots>::Zero();
  for (int s = 0; s < ShellForms::num_slots; ++s) {
    for (int t = 0; t < ShellForms::num_slots; ++t) M(place(s), place(t)) = mass_(s, t);
  }
  return M;
}

}  // namespace culm::shell
