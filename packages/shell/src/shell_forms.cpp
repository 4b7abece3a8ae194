#include <culm/shell/shell_forms.hpp>

#include "shell_modes.hpp"

namespace culm::shell {

namespace {

constexpr int num_modes = ShellForms::num_modes;
constexpr int num_forms = ShellForms::num_strains;

}  // namespace

ShellForms::Modes ShellForms::modes(const Nodes& q) noexcept {
  const auto x = [&](int a) { return q.col(2 * a); };
  const auto d = [&](int a) { return q.col(2 * a + 1); };
  Modes p;
  p.col(0) = 0.25 * ((x(2) - x(0)) + (x(1) - x(3)));
  p.col(1) = 0.25 * ((x(2) - x(0)) - (x(1) - x(3)));
  p.col(2) = 0.25 * ((x(0) - x(1)) + (x(2) - x(3)));
  p.col(3) = 0.25 * ((d(2) + d(0)) + (d(1) + d(3)));
  p.col(4) = 0.25 * ((d(2) - d(0)) + (d(1) - d(3)));
  p.col(5) = 0.25 * ((d(2) - d(0)) - (d(1) - d(3)));
  p.col(6) = 0.25 * ((d(0) - d(1)) + (d(2) - d(3)));
  return p;
}

ShellForms::Strain ShellForms::products(const Modes& p) noexcept {
  Strain y;
  for (int i = 0; i < num_modes; ++i) {
    y[form(i, i)] = 0.5 * p.col(i).squaredNorm();
    for (int j = i + 1; j < num_modes; ++j) y[form(i, j)] = p.col(i).dot(p.col(j));
  }
  return y;
}

void ShellForms::strain(int, const Nodes& q, Strain& y) const noexcept {
  y = products(modes(q)) - reference_;
}

void ShellForms::gradient(int, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept {
  const Modes p = modes(q);
  B.setZero();
  for (int s = 0; s < num_slots; ++s) {
    for (int i = 0; i < num_modes; ++i) {
      if (share(s, i) == 0.0) continue;
      for (int j = 0; j < num_modes; ++j) {
        B.block<3, 1>(3 * s, form(i, j)) += share(s, i) * p.col(j);
      }
    }
  }
}

void ShellForms::add_curvature(int, const Strain& S, SlotMatrix<num_slots>& A) const noexcept {
  Mat<num_modes, num_slots> SH = Mat<num_modes, num_slots>::Zero();
  for (int i = 0; i < num_modes; ++i) {
    for (int j = 0; j < num_modes; ++j) {
      for (int s = j < 3 ? 0 : 1; s < num_slots; s += 2) {
        SH(i, s) += S[form(i, j)] * share(s, j);
      }
    }
  }
  for (int s = 0; s < num_slots; ++s) {
    for (int i = s % 2 == 0 ? 0 : 3; i < (s % 2 == 0 ? 3 : num_modes); ++i) {
      A.row(s) += share(s, i) * SH.row(i);
    }
  }
}

void ShellForms::add_force(const Nodes& q, const Strain& S, Nodes& f) noexcept {
  const Modes p = modes(q);
  for (int i = 0; i < num_modes; ++i) {
    Vec3 force = S[form(i, 0)] * p.col(0);
    for (int j = 1; j < num_modes; ++j) force += S[form(i, j)] * p.col(j);
    for (int s = i < 3 ? 0 : 1; s < num_slots; s += 2) f.col(s) += share(s, i) * force;
  }
}

// In modes, K_ik = Σ_jl C[ij, kl] p_j r_l^T. First over j, where rows of C are added; then over l,
// where rows of the transposed intermediate result are: both run along contiguous memory.
void ShellForms::add_stiffness(const Nodes& mid, const Nodes& next, const Stiffness& C,
                               double factor, RowMat<3 * num_slots, 3 * num_slots>& K) noexcept {
  const Modes p = modes(mid);
  const Modes r = factor * modes(next);
  RowMat<3 * num_modes, num_forms> pC;
  for (int i = 0; i < num_modes; ++i) {
    for (int c = 0; c < 3; ++c) {
      pC.row(3 * i + c) = p(c, 0) * C.row(form(i, 0));
      for (int j = 1; j < num_modes; ++j) pC.row(3 * i + c) += p(c, j) * C.row(form(i, j));
    }
  }
  RowMat<24, num_forms> BC;
  spread(pC, BC);
  const RowMat<num_forms, 24> CB = BC.transpose();
  RowMat<3 * num_modes, 24> rCB;
  for (int k = 0; k < num_modes; ++k) {
    for (int c = 0; c < 3; ++c) {
      rCB.row(3 * k + c) = r(c, 0) * CB.row(form(k, 0));
      for (int l = 1; l < num_modes; ++l) rCB.row(3 * k + c) += r(c, l) * CB.row(form(k, l));
    }
  }
  RowMat<24, 24> transposed;
  spread(rCB, transposed);
  K += transposed.transpose();
}

}  // namespace culm::shell
