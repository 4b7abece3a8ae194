/// What the laws of element_contract.hpp start from.
#pragma once

#include <culm/mechanics/element.hpp>

#include <Eigen/Geometry>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

namespace culm::kit {

/// An element made by a case, two admissible states, and its kernels with values as results.
template <class Case>
class ElementContract : public testing::Test {
 protected:
  using E = typename Case::Type;
  static_assert(Element<E>);
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;
  static constexpr int N = 3 * S;
  static constexpr int slots_per_node = slots_of(E::node_kind);
  using Q = Slots<S>;
  using Strain = Vec<M>;

  const E element = Case::make();
  const Q q0 = Case::state(1);
  const Q q1 = Case::state(2);
  const Strain S_random = Random(5).matrix<M, 1>();
  // anything, admissible or not: for the laws that hold at every q
  const Q q_any = q0 + 0.3 * Random(7).matrix<3, S>();

  // The steps of statics, of the conserving scheme, and with half and full numerical dissipation.
  static constexpr Stencil stencils[] = {
      Stencil::statics(), Stencil::midpoint(0.1), {0.1, 0.5, 0.75}, {0.1, 0.5, 1.0}};

  static Vec<N> flat(const Q& q) { return q.template reshaped<Eigen::ColMajor>(); }
  static Q unflat(const Vec<N>& v) { return Eigen::Map<const Q>(v.data()); }

  Strain strain(int point, const Q& q) const {
    Strain y;
    element.strain(point, q, y);
    return y;
  }
  Gradient<S, M> gradient(int point, const Q& q) const {
    Gradient<S, M> B;
    B.setConstant(1e30);  // must be overwritten
    element.gradient(point, q, B);
    return B;
  }
  Response<M> respond(int point, const Strain& prev, const Strain& next,
                      const Stencil& stencil) const {
    Response<M> response;
    EXPECT_EQ(element.respond(point, prev, next, stencil, response), Verdict::ok);
    return response;
  }
  static double largest(const auto& m) { return m.cwiseAbs().maxCoeff(); }

  // What stress S does on the slots of a point: resultant force, and moment about the origin.
  static void expect_no_resultant(const Vec<N>& f, const Q& q, double scale) {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (int s = 0; s < S; ++s) {
      const Vec3 f_s = f.template segment<3>(3 * s);
      if (s % slots_per_node == 0) force += f_s;
      moment += q.col(s).cross(f_s);
    }
    EXPECT_LT(force.norm(), 1e-14 * scale);
    EXPECT_LT(moment.norm(), 1e-14 * scale * (1.0 + largest(q)));
  }
};

}  // namespace culm::kit
