#include <culm/beam/helical_beam.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace culm::beam {

namespace {

// Of |dz|^2; below, the correction of the stress, of third order in dz, is smaller than round-off.
constexpr double smallest_change = 1e-16;

const double least_cosine = std::cos(HelicalBeam::max_rotation);

// z of the relative motion of the two nodes; r divided by h.
Vec<7> invariants(const Slots<8>& q, double h) noexcept {
  const Mat3 Lam = q.middleCols<3>(1).transpose() * q.middleCols<3>(5);
  Vec<7> z;
  z[0] = 0.5 * (Lam.trace() - 1.0);
  for (int i = 0; i < 3; ++i) {
    const int j = next_axis(i);
    const int k = next_axis(j);
    z[1 + i] = 0.5 * (Lam(k, j) - Lam(j, k));
  }
  z.tail<3>() = q.middleCols<3>(1).transpose() * (q.col(4) - q.col(0)) / h;
  return z;
}

// Arc length of the helix through both nodes: |Γ| before division by h.
double helix_length(const Slots<8>& reference) {
  return helical_strain(invariants(reference, 1.0), 1.0).head<3>().norm();
}

}  // namespace

HelicalBeam::HelicalBeam(const Nodes& reference, const Mat6& stiffness,
                         const std::array<Mat3, num_mass_points>& mass)
    : length_(helix_length(reference)), stiffness_(stiffness) {
  z_reference_ = invariants(reference, length_);
  strain_reference_ = helical_strain(z_reference_, length_);
  const auto rule = gauss_legendre(num_mass_points);
  for (std::size_t g = 0; g < mass_.size(); ++g) {
    mass_[g] = 0.5 * length_ * rule[g].weight * mass[g];
  }
}

void HelicalBeam::strain(int, const Nodes& q, Strain& y) const noexcept {
  y = invariants(q, length_) - z_reference_;
}

// c: ∂/∂d_i^1 = 1/2 d_i^2          a_i: ∂/∂d_k^1 = 1/2 d_j^2 , ∂/∂d_j^1 = -1/2 d_k^2 , ...
// r_i: ∂/∂d_i^1 = (x2 - x1) / h , ∂/∂x2 = -∂/∂x1 = d_i^1 / h
void HelicalBeam::gradient(int, const Nodes& q,
                           Gradient<num_slots, num_strains>& B) const noexcept {
  const auto first = q.middleCols<3>(1);
  const auto second = q.middleCols<3>(5);
  const Vec3 chord = (q.col(4) - q.col(0)) / length_;
  B.setZero();
  for (int i = 0; i < 3; ++i) {
    const int j = next_axis(i);
    const int k = next_axis(j);
    B.block<3, 1>(3 + 3 * i, 0) = 0.5 * second.col(i);
    B.block<3, 1>(15 + 3 * i, 0) = 0.5 * first.col(i);
    B.block<3, 1>(3 + 3 * k, 1 + i) = 0.5 * second.col(j);
    B.block<3, 1>(3 + 3 * j, 1 + i) = -0.5 * second.col(k);
    B.block<3, 1>(15 + 3 * j, 1 + i) = 0.5 * first.col(k);
    B.block<3, 1>(15 + 3 * k, 1 + i) = -0.5 * first.col(j);
    B.block<3, 1>(3 + 3 * i, 4 + i) = chord;
    B.block<3, 1>(0, 4 + i) = -first.col(i) / length_;
    B.block<3, 1>(12, 4 + i) = first.col(i) / length_;
  }
}

void HelicalBeam::add_curvature(int, const Strain& S, SlotMatrix<num_slots>& A) const noexcept {
  const auto add = [&A](int s, int t, double value) {
    A(s, t) += value;
    A(t, s) += value;
  };
  for (int i = 0; i < 3; ++i) {
    const int j = next_axis(i);
    const int k = next_axis(j);
    add(1 + i, 5 + i, 0.5 * S[0]);
    add(1 + k, 5 + j, 0.5 * S[1 + i]);
    add(1 + j, 5 + k, -0.5 * S[1 + i]);
    add(1 + i, 0, -S[4 + i] / length_);
    add(1 + i, 4, S[4 + i] / length_);
  }
}

Verdict HelicalBeam::check(const Vec<num_strains>& z) const noexcept {
  if (!(z[0] > least_cosine)) return Verdict::inverted_element;
  if (!(helical_rotation(z) < 6.0)) return Verdict::law_out_of_range;
  return Verdict::ok;
}

// theta = 1:  S = Σ_I ∂e_I/∂z w_I at the new end ,  w = h C e_alg
// else:       S = Y^T w ,  Y = ∂e/∂z(z_mid) + [Δe - ∂e/∂z(z_mid) Δz] Δz^T / |Δz|^2          (1.12)
Verdict HelicalBeam::respond(int, const Strain& prev, const Strain& next, const Stencil& stencil,
                             Response<num_strains>& response) const noexcept {
  const Vec<7> z1 = next + z_reference_;
  const Verdict verdict = check(z1);
  if (verdict != Verdict::ok) {
    response.stress.setZero();
    response.tangent.setZero();
    return verdict;
  }
  const double weight = stencil.theta_strain;
  Vec6 e = weight * (helical_strain(z1, length_) - strain_reference_);
  if (weight != 1.0) e += (1.0 - weight) * section_strain(prev);
  const Vec6 w = length_ * stiffness_ * e;
  if (!response.wants_tangent) {
    response.stress = stencil.theta == 1.0
                          ? Vec<7>(helical_strain_gradient(z1, length_).transpose() * w)
                          : step_stress(prev + z_reference_, z1, w);
    return verdict;
  }
  const Mat<6, 7> J1 = helical_strain_gradient(z1, length_);
  const Mat<6, 7> CJ1 = weight * length_ * stiffness_ * J1;  // ∂w/∂z1
  if (stencil.theta == 1.0) {
    const WeightedHelicalStrain at_end = weigh_helical_strain(z1, w, length_);
    response.stress = at_end.gradient;
    response.tangent = at_end.hessian + J1.transpose() * CJ1;
    return verdict;
  }
  const Vec<7> z0 = prev + z_reference_;
  const Vec<7> zm = 0.5 * (z0 + z1);
  const Vec<7> dz = next - prev;
  const WeightedHelicalStrain at_mid = weigh_helical_strain(zm, w, length_);
  Mat<6, 7> Y = helical_strain_gradient(zm, length_);
  response.stress = at_mid.gradient;
  response.tangent = 0.5 * at_mid.hessian;
  const double n = dz.squaredNorm();
  if (n > smallest_change) {
    const Vec6 defect = helical_strain_increment(z0, z1, length_) - Y * dz;
    const double kappa = w.dot(defect) / n;
    // ∂(w . defect)/∂z1 at fixed w
    const Vec<7> turn = J1.transpose() * w - at_mid.gradient - 0.5 * at_mid.hessian * dz;
    response.stress += kappa * dz;
    response.tangent += dz * ((turn - 2.0 * kappa * dz) / n).transpose();
    response.tangent.diagonal().array() += kappa;
    Y += defect * dz.transpose() / n;
  }
  response.tangent += Y.transpose() * CJ1;
  return verdict;
}

// S alone of (1.12)
Vec<7> HelicalBeam::step_stress(const Vec<7>& z0, const Vec<7>& z1, const Vec6& w) const noexcept {
  const Vec<7> dz = z1 - z0;
  const Mat<6, 7> Y = helical_strain_gradient(0.5 * (z0 + z1), length_);
  Vec<7> stress = Y.transpose() * w;
  const double n = dz.squaredNorm();
  if (n > smallest_change) {
    stress += w.dot(helical_strain_increment(z0, z1, length_) - Y * dz) / n * dz;
  }
  return stress;
}

double HelicalBeam::energy(int, const Strain& y) const noexcept {
  if (check(y + z_reference_) != Verdict::ok) return std::numeric_limits<double>::quiet_NaN();
  const Vec6 e = section_strain(y);
  return 0.5 * length_ * e.dot(stiffness_ * e);
}

Vec6 HelicalBeam::section_strain(const Strain& y) const noexcept {
  return helical_strain(y + z_reference_, length_) - strain_reference_;
}

Vec6 HelicalBeam::resultants(int, const Strain& y) const noexcept {
  return stiffness_ * section_strain(y);
}

SlotMatrix<HelicalBeam::num_slots> HelicalBeam::mass() const noexcept {
  SlotMatrix<num_slots> M = SlotMatrix<num_slots>::Zero();
  const auto rule = gauss_legendre(num_mass_points);
  for (std::size_t g = 0; g < mass_.size(); ++g) {
    const Vec<2> N = Lagrange<1>::values(rule[g].xi);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) M.block<3, 3>(4 * a, 4 * b) += N[a] * N[b] * mass_[g];
    }
  }
  return M;
}

}  // namespace culm::beam
