#include <culm/beam/director_beam.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace culm::beam {

namespace {

// Cyclic partners of a director: (i, j, k) = (0, 1, 2), (1, 2, 0), (2, 0, 1).
// The axis and its triad at a point, interpolated: columns x, d1, d2, d3.
using Frame = Mat<3, 4>;

template <int Nodes, int S>
inline Frame interpolate(const Vec<Nodes>& N, const Slots<S>& q) noexcept {
  Frame frame = N[0] * q.template middleCols<4>(0);
  for (int a = 1; a < Nodes; ++a) frame += N[a] * q.template middleCols<4>(4 * a);
  return frame;
}

// |dX/dxi| of the reference axis
template <int Nodes, int S>
double axis_jacobian(const Vec<Nodes>& dN, const Slots<S>& reference) {
  return interpolate<Nodes, S>(dN, reference).col(0).norm();
}

}  // namespace

template <int Order>
DirectorBeam<Order>::DirectorBeam(const Nodes& reference,
                                  const std::array<Mat6, num_points>& stiffness,
                                  const std::array<Mat3, num_mass_points>& mass) {
  using Shape = Lagrange<Order>;
  const auto rule = gauss_legendre(num_points);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    Point& point = points_[g];
    const Vec<num_nodes> dN = Shape::derivatives(rule[g].xi);
    const double J = axis_jacobian<num_nodes, num_slots>(dN, reference);
    point.N = Shape::values(rule[g].xi);
    point.dN = dN / J;
    point.length = rule[g].weight * J;
    point.stiffness = stiffness[g];
    point.reference = absolute_strain(point, reference);
  }
  const auto mass_rule = gauss_legendre(num_mass_points);
  for (std::size_t g = 0; g < mass_points_.size(); ++g) {
    const double J =
        axis_jacobian<num_nodes, num_slots>(Shape::derivatives(mass_rule[g].xi), reference);
    mass_points_[g].N = Shape::values(mass_rule[g].xi);
    mass_points_[g].length = mass_rule[g].weight * J;
    mass_points_[g].mass = mass[g];
  }
}

// Γ_i = d_i . x' ,  K_i = 1/2 (d_j' . d_k - d_k' . d_j)
template <int Order>
typename DirectorBeam<Order>::Strain DirectorBeam<Order>::absolute_strain(const Point& point,
                                                                          const Nodes& q) noexcept {
  const Frame f = interpolate<num_nodes, num_slots>(point.N, q);
  const Frame df = interpolate<num_nodes, num_slots>(point.dN, q);
  Strain e;
  for (int i = 0; i < 3; ++i) {
    const int j = next_axis(i);
    const int k = next_axis(j);
    e[i] = f.col(1 + i).dot(df.col(0));
    e[3 + i] = 0.5 * (df.col(1 + j).dot(f.col(1 + k)) - df.col(1 + k).dot(f.col(1 + j)));
  }
  return e;
}

template <int Order>
void DirectorBeam<Order>::strain(int point, const Nodes& q, Strain& e) const noexcept {
  e = absolute_strain(at(point), q) - at(point).reference;
}

// ∂Γ_i/∂x_a = N'_a d_i            ∂K_i/∂d_j,a = 1/2 (N'_a d_k - N_a d_k')
// ∂Γ_i/∂d_i,a = N_a x'            ∂K_i/∂d_k,a = 1/2 (N_a d_j' - N'_a d_j)
template <int Order>
void DirectorBeam<Order>::gradient(int point, const Nodes& q,
                                   Gradient<num_slots, num_strains>& B) const noexcept {
  const Point& p = at(point);
  const Frame f = interpolate<num_nodes, num_slots>(p.N, q);
  const Frame df = interpolate<num_nodes, num_slots>(p.dN, q);
  B.setZero();
  for (int a = 0; a < num_nodes; ++a) {
    // h_i = 1/2 (N'_a d_i - N_a d_i') serves both curvatures in which d_i appears
    const Mat3 h =
        0.5 * (p.dN[a] * f.template rightCols<3>() - p.N[a] * df.template rightCols<3>());
    B.template block<3, 3>(12 * a, 0) = p.dN[a] * f.template rightCols<3>();
    for (int i = 0; i < 3; ++i) {
      const int j = next_axis(i);
      const int k = next_axis(j);
      B.template block<3, 1>(12 * a + 3 * (1 + i), i) = p.N[a] * df.col(0);
      B.template block<3, 1>(12 * a + 3 * (1 + j), 3 + i) = h.col(k);
      B.template block<3, 1>(12 * a + 3 * (1 + k), 3 + i) = -h.col(j);
    }
  }
}

// Γ_i: A[x_b, d_i,a] = N_a N'_b        K_i: A[d_j,a, d_k,b] = 1/2 (N'_a N_b - N_a N'_b)
template <int Order>
void DirectorBeam<Order>::add_curvature(int point, const Strain& S,
                                        SlotMatrix<num_slots>& A) const noexcept {
  const Point& p = at(point);
  for (int a = 0; a < num_nodes; ++a) {
    for (int b = 0; b < num_nodes; ++b) {
      const double shear = p.N[a] * p.dN[b];
      const double bend = 0.5 * (p.dN[a] * p.N[b] - p.N[a] * p.dN[b]);
      for (int i = 0; i < 3; ++i) {
        const int j = next_axis(i);
        const int k = next_axis(j);
        A(4 * b, 4 * a + 1 + i) += shear * S[i];
        A(4 * a + 1 + i, 4 * b) += shear * S[i];
        A(4 * a + 1 + j, 4 * b + 1 + k) += bend * S[3 + i];
        A(4 * b + 1 + k, 4 * a + 1 + j) += bend * S[3 + i];
      }
    }
  }
}

// S = w C ((1 - ϑ) e_prev + ϑ e_next)
template <int Order>
Verdict DirectorBeam<Order>::respond(int point, const Strain& prev, const Strain& next,
                                     const Stencil& stencil,
                                     Response<num_strains>& response) const noexcept {
  const Mat6 C = this->stiffness(point);
  const double weight = stencil.theta_strain;
  const Strain e = (1.0 - weight) * prev + weight * next;
  response.stress.noalias() = C * e;
  response.tangent = weight * C;
  return Verdict::ok;
}

template <int Order>
double DirectorBeam<Order>::energy(int point, const Strain& e) const noexcept {
  return 0.5 * at(point).length * e.dot(at(point).stiffness * e);
}

// Mh[(r,a),(s,b)] = Σ_g w J m3[r,s] N_a N_b
template <int Order>
SlotMatrix<DirectorBeam<Order>::num_slots> DirectorBeam<Order>::mass() const noexcept {
  SlotMatrix<num_slots> M = SlotMatrix<num_slots>::Zero();
  for (const MassPoint& p : mass_points_) {
    for (int a = 0; a < num_nodes; ++a) {
      for (int b = 0; b < num_nodes; ++b) {
        M.template block<3, 3>(4 * a, 4 * b) += p.N[a] * p.N[b] * p.length * p.mass;
      }
    }
  }
  return M;
}

template <int Order>
Vec6 DirectorBeam<Order>::resultants(int point, const Strain& e) const noexcept {
  return at(point).stiffness * e;
}

template class DirectorBeam<1>;
template class DirectorBeam<2>;
template class DirectorBeam<3>;

}  // namespace culm::beam
