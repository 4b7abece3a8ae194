#include <culm/contact/sliding.hpp>

#include <Eigen/LU>

namespace culm::contact {

// With dslot_t the changes at the end of the step and e_t those of r, dr = sum_t e_t dslot_t:
//   dxi  = D^-1 sum_t c_t dslot_t             c: +-s theta e_t of r, -theta xi_k of its directors
//   dway = sum_t (U_t 1 + c2_t M2 - c1_t M1) dslot_t      M = (moved) D^-1
//   dv_t = P dv - (n dn^T + dn n^T) v,  dn = theta P dr / |r|
//   df   = N share' dv_t + share dN
Sliding slide(const Pressed& pressed, const Friction& friction, const Stencil& stencil,
              bool tangent) {
  const auto& [first, second, r, N, N_r] = pressed;
  const double distance = r.norm();
  const Vec3 n = r / distance;
  const Mat3 P = Mat3::Identity() - n * n.transpose();
  const Mat3 inverse1 = first.directors.inverse();
  const Mat3 inverse2 = second.directors.inverse();
  const Vec3 xi1 = first.share * inverse1 * r;
  const Vec3 xi2 = -second.share * inverse2 * r;
  Sliding found;
  found.factors << -1.0, -xi1, 1.0, xi2;
  const Vec3 v = (second.way + second.moved * xi2 - first.way - first.moved * xi1) / stencil.step;
  const Vec3 slip = P * v;
  const Vec3 share = friction.share(slip);
  found.force = N * share;
  found.taken = -found.force.dot(slip) * stencil.step;
  if (!tangent) return found;

  const double theta = stencil.theta;
  Vec<8> e, c1, c2;
  e << -1.0, Vec3::Zero(), 1.0, Vec3::Zero();
  c1 = theta * first.share * e;
  c2 = -theta * second.share * e;
  c1.segment<3>(1) = -theta * xi1;
  c2.segment<3>(5) = -theta * xi2;
  const Mat3 M1 = first.moved * inverse1;
  const Mat3 M2 = second.moved * inverse2;
  const Mat3 by_slip = N * friction.derivative(slip);
  const Mat3 by_r =
      share * N_r.transpose() - theta / distance * by_slip * (n * slip.transpose() + n.dot(v) * P);
  for (int t = 0; t < 8; ++t) {
    const Mat3 by_slot = by_slip * P / stencil.step *
                             (found.factors[t] * Mat3::Identity() + c2[t] * M2 - c1[t] * M1) +
                         e[t] * by_r;
    for (int s = 0; s < 8; ++s) {
      auto block = found.tangent.block<3, 3>(3 * s, 3 * t);
      block = -found.factors[s] * by_slot;
      if (s % 4 == 0) continue;
      if (s < 4) block += c1[t] * found.force * inverse1.row(s - 1);
      if (s > 4) block -= c2[t] * found.force * inverse2.row(s - 5);
    }
  }
  return found;
}

}  // namespace culm::contact
