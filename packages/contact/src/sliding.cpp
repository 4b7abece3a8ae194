#include <culm/contact/sliding.hpp>

#include <Eigen/LU>

namespace culm::contact {

// With the place p where both surfaces meet, M = (moved) D^-1, and w the way of one point past the
// other less what the friction of before stands for:
//   dxi_t  = D^-1 (dp_t - theta (1 | xi_k) of its own slots)
//   dw_t   = +-(1 | xi_k) + M2 D2 dxi2_t - M1 D1 dxi1_t - theta grip_k / stiffness
//   dway_t = P dw_t - (n w^T + n . w 1) dn_t
//   df_t   = by_way dway_t + by_normal dN_t
Sliding slide(const Pressed& pressed, const Friction& friction, const Stencil& stencil,
              bool tangent) {
  const auto& [first, second, n, N, stiffness, grip, place_by, normal_by, force_by] = pressed;
  const Mat3 P = Mat3::Identity() - n * n.transpose();
  const Mat3 inverse1 = first.directors.inverse();
  const Mat3 inverse2 = second.directors.inverse();
  const Vec3 xi1 = inverse1 * first.arm;
  const Vec3 xi2 = inverse2 * second.arm;
  const bool rests = stencil.step == 0.0;
  const Vec3 held = rests ? Vec3(grip / stiffness) : Vec3(Vec3::Zero());
  Sliding found;
  found.factors << -1.0, -xi1, 1.0, xi2;
  const Vec3 moved = second.way + second.moved * xi2 - first.way - first.moved * xi1;
  const Vec3 w = moved - first.directors * held;
  found.way = P * moved;
  const Rubbing rubbing =
      rests ? stick(friction, N, stiffness, P * w) : rub(friction, N, found.way, stencil.step);
  found.force = rubbing.force;
  if (!tangent) return found;

  const double theta = stencil.theta;
  const Mat3 turned = n * w.transpose() + n.dot(w) * Mat3::Identity();
  for (int t = 0; t < 8; ++t) {
    const auto at = static_cast<std::size_t>(t);
    const bool of_first = t < 4;
    const double lever = theta * (of_first ? -1.0 : 1.0) * found.factors[t];
    Mat3 dxi1 = place_by[at];
    Mat3 dxi2 = place_by[at];
    (of_first ? dxi1 : dxi2) -= lever * Mat3::Identity();
    dxi1 = inverse1 * dxi1;
    dxi2 = inverse2 * dxi2;
    Mat3 dw = found.factors[t] * Mat3::Identity() + second.moved * dxi2 - first.moved * dxi1;
    if (of_first && t > 0) dw -= theta * held[t - 1] * Mat3::Identity();
    const Mat3 by_slot = rubbing.by_way * (P * dw - turned * normal_by[at]) +
                         rubbing.by_normal * force_by[at].transpose();
    for (int s = 0; s < 8; ++s) {
      auto block = found.tangent.block<3, 3>(3 * s, 3 * t);
      block = -found.factors[s] * by_slot;
      if (s % 4 == 0) continue;
      if (s < 4) block += found.force * dxi1.row(s - 1);
      if (s > 4) block -= found.force * dxi2.row(s - 5);
    }
  }
  return found;
}

}  // namespace culm::contact
