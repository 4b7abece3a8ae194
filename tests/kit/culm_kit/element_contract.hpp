/// The laws every element obeys, as one typed test suite. A test file brings them all by one line:
///
///     INSTANTIATE_TYPED_TEST_SUITE_P(Cable, ElementContract, testing::Types<CableCase>);
///
/// where the case says how to make the element:
///
///     struct CableCase {
///       using Type = CableElement;
///       static Type make();                            // curved, warped, fully coupled
///       static Slots<Type::num_slots> reference();     // stress free
///       static Slots<Type::num_slots> state(int seed); // admissible and far from the reference
///       static double total_mass();                    // [kg]
///       static Slots<Type::num_slots> inverted();      // optional: beyond the element's range
///     };
/// @source formulation 0.3, 4.3, 8.2
#pragma once

#include <Eigen/Eigenvalues>
#include <culm_kit/element_fixture.hpp>
#include <culm_kit/finite_difference.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::kit {

TYPED_TEST_SUITE_P(ElementContract);

TYPED_TEST_P(ElementContract, GradientIsDerivativeOfStrain) {
  using T = TestFixture;
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto B = this->gradient(p, this->q_any);
    // a quadratic form has no higher derivatives, hence the large step
    const auto difference = central_difference<T::M, T::N>(
        [&](const Vec<T::N>& q) { return this->strain(p, T::unflat(q)); }, T::flat(this->q_any),
        1.0);
    EXPECT_LT(relative_difference(difference, B.transpose()), 1e-14) << "point " << p;
  }
}

TYPED_TEST_P(ElementContract, CurvatureIsDerivativeOfGradient) {
  using T = TestFixture;
  for (int p = 0; p < T::E::num_points; ++p) {
    SlotMatrix<T::S> A = SlotMatrix<T::S>::Constant(1.0);  // it is added to
    this->element.add_curvature(p, this->S_random, A);
    A.array() -= 1.0;
    const auto K = central_difference<T::N, T::N>(
        [&](const Vec<T::N>& q) -> Vec<T::N> {
          return this->gradient(p, T::unflat(q)) * this->S_random;
        },
        T::flat(this->q_any), 1.0);
    for (int s = 0; s < T::S; ++s) {
      for (int t = 0; t < T::S; ++t) {
        const Mat3 block = K.template block<3, 3>(3 * s, 3 * t);
        EXPECT_LT(T::largest(block - A(s, t) * Mat3::Identity()), 1e-14 * T::largest(K))
            << "point " << p << ", slots " << s << ", " << t;
      }
    }
  }
}

TYPED_TEST_P(ElementContract, StrainIncrementIsMidpointGradientTimesMotion) {
  using T = TestFixture;
  const auto mid = (0.5 * (this->q0 + this->q1)).eval();
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto B = this->gradient(p, mid);
    const Vec<T::N> dq = T::flat(this->q1 - this->q0);
    const auto defect =
        (this->strain(p, this->q1) - this->strain(p, this->q0) - B.transpose() * dq).eval();
    const double scale = (B.cwiseAbs().transpose() * dq.cwiseAbs()).maxCoeff();
    EXPECT_LT(T::largest(defect), 1e-14 * scale) << "point " << p;
  }
}

TYPED_TEST_P(ElementContract, StrainIgnoresRigidMotion) {
  using T = TestFixture;
  const RigidMotion move = RigidMotion::random(3);
  for (const auto& q : {this->q0, this->q_any}) {
    for (int p = 0; p < T::E::num_points; ++p) {
      const auto change = (this->strain(p, move(q, T::E::node_kind)) - this->strain(p, q)).eval();
      EXPECT_LT(T::largest(change), 1e-14 * (10.0 + T::largest(this->strain(p, q))));
    }
  }
}

TYPED_TEST_P(ElementContract, RigidlyMovedReferenceIsStressFree) {
  using T = TestFixture;
  const RigidMotion move = RigidMotion::random(4);
  const auto q = move(TypeParam::reference(), T::E::node_kind);
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto y = this->strain(p, q);
    EXPECT_LT(T::largest(y), 1e-14);
    EXPECT_LT(this->element.energy(p, y), 1e-26);
    const auto response = this->respond(p, y, y, Stencil::statics());
    EXPECT_LT(T::largest(response.stress), 1e-14 * T::largest(response.tangent) * T::M);
  }
}

TYPED_TEST_P(ElementContract, StressesExertNoForceAndNoMoment) {
  using T = TestFixture;
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto B = this->gradient(p, this->q_any);
    const double scale = (B.cwiseAbs() * this->S_random.cwiseAbs()).sum();
    T::expect_no_resultant(B * this->S_random, this->q_any, scale);
  }
}

TYPED_TEST_P(ElementContract, StressIsEnergyDerivative) {
  using T = TestFixture;
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto y = this->strain(p, this->q1);
    const auto stress = this->respond(p, this->strain(p, this->q0), y, Stencil::statics()).stress;
    const auto difference = central_difference<1, T::M>(
        [&](const Vec<T::M>& at) { return Vec<1>(this->element.energy(p, at)); }, y);
    EXPECT_LT(relative_difference(difference.transpose(), stress), 2e-9);
  }
}

TYPED_TEST_P(ElementContract, TangentIsStressDerivative) {
  using T = TestFixture;
  for (const Stencil& stencil : T::stencils) {
    for (int p = 0; p < T::E::num_points; ++p) {
      const auto prev = this->strain(p, this->q0);
      const auto next = this->strain(p, this->q1);
      const auto difference = central_difference<T::M, T::M>(
          [&](const Vec<T::M>& y) { return this->respond(p, prev, y, stencil).stress; }, next);
      EXPECT_LT(relative_difference(difference, this->respond(p, prev, next, stencil).tangent),
                2e-9)
          << "theta " << stencil.theta << ", strain " << stencil.theta_strain;
    }
  }
}

TYPED_TEST_P(ElementContract, MidpointForceDoesTheStoredWork) {
  using T = TestFixture;
  const auto mid = (0.5 * (this->q0 + this->q1)).eval();
  const Vec<T::N> dq = T::flat(this->q1 - this->q0);
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto prev = this->strain(p, this->q0);
    const auto next = this->strain(p, this->q1);
    const auto stress = this->respond(p, prev, next, Stencil::midpoint(0.1)).stress;
    const double stored = this->element.energy(p, next) - this->element.energy(p, prev);
    const double scale = this->element.energy(p, next) + this->element.energy(p, prev);
    EXPECT_NEAR(stress.dot(next - prev), stored, 1e-13 * scale);
    EXPECT_NEAR((this->gradient(p, mid) * stress).dot(dq), stored, 1e-13 * scale);
  }
}

TYPED_TEST_P(ElementContract, DissipationTakesEnergyAndNeverGivesAny) {
  using T = TestFixture;
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto prev = this->strain(p, this->q0);
    const auto next = this->strain(p, this->q1);
    const double stored = this->element.energy(p, next) - this->element.energy(p, prev);
    double less = 0.0;
    for (const double theta_strain : {0.6, 0.75, 1.0}) {
      const auto stress = this->respond(p, prev, next, {0.1, 0.5, theta_strain}).stress;
      const double lost = stress.dot(next - prev) - stored;
      EXPECT_GT(lost, less);
      less = lost;
    }
  }
}

TYPED_TEST_P(ElementContract, StepWithoutMotionHasTheStressOfItsEnds) {
  using T = TestFixture;
  for (int p = 0; p < T::E::num_points; ++p) {
    const auto y = this->strain(p, this->q1);
    const auto still = this->respond(p, y, y, Stencil::midpoint(0.1)).stress;
    const auto at_rest = this->respond(p, y, y, Stencil::statics()).stress;
    EXPECT_LT(relative_difference(still, at_rest), 1e-14);
  }
}

TYPED_TEST_P(ElementContract, MassIsSymmetricPositiveAndComplete) {
  using T = TestFixture;
  const auto Mh = this->element.mass();
  EXPECT_LT(T::largest(Mh - Mh.transpose()), 1e-15 * T::largest(Mh));
  const Eigen::SelfAdjointEigenSolver<SlotMatrix<T::S>> eigen(Mh);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-14 * eigen.eigenvalues().maxCoeff());
  double total = 0.0;
  for (int s = 0; s < T::S; s += T::slots_per_node) {
    for (int t = 0; t < T::S; t += T::slots_per_node) total += Mh(s, t);
  }
  EXPECT_NEAR(total, TypeParam::total_mass(), 1e-13 * TypeParam::total_mass());
}

TYPED_TEST_P(ElementContract, KernelsAllocateNothing) {
  using T = TestFixture;
  typename T::Strain y;
  Gradient<T::S, T::M> B;
  SlotMatrix<T::S> A = SlotMatrix<T::S>::Zero();
  Response<T::M> response;
  double sum = 0.0;
  {
    const NoHeap guard;
    for (int p = 0; p < T::E::num_points; ++p) {
      this->element.strain(p, this->q1, y);
      this->element.gradient(p, this->q1, B);
      this->element.add_curvature(p, y, A);
      for (const Stencil& stencil : T::stencils) {
        this->element.respond(p, y, y, stencil, response);
        sum += response.stress.sum() + response.tangent.sum();
      }
      sum += B.sum() + A.sum() + this->element.energy(p, y);
    }
    sum += this->element.mass().sum();
  }
  EXPECT_TRUE(std::isfinite(sum));
}

TYPED_TEST_P(ElementContract, InvertedInputHasAVerdict) {
  using T = TestFixture;
  if constexpr (requires { TypeParam::inverted(); }) {
    Response<T::M> response;
    const auto y = this->strain(0, TypeParam::inverted());
    for (const Stencil& stencil : T::stencils) {
      EXPECT_EQ(this->element.respond(0, this->strain(0, this->q0), y, stencil, response),
                Verdict::inverted_element);
      EXPECT_TRUE(response.stress.allFinite());
    }
    EXPECT_TRUE(std::isnan(this->element.energy(0, y)));
  } else {
    // a linear law on quadratic forms answers every configuration
    Response<T::M> response;
    const auto y = this->strain(0, -this->q_any);
    EXPECT_EQ(this->element.respond(0, y, y, Stencil::statics(), response), Verdict::ok);
  }
}

REGISTER_TYPED_TEST_SUITE_P(ElementContract, GradientIsDerivativeOfStrain,
                            CurvatureIsDerivativeOfGradient,
                            StrainIncrementIsMidpointGradientTimesMotion, StrainIgnoresRigidMotion,
                            RigidlyMovedReferenceIsStressFree, StressesExertNoForceAndNoMoment,
                            StressIsEnergyDerivative, TangentIsStressDerivative,
                            MidpointForceDoesTheStoredWork, DissipationTakesEnergyAndNeverGivesAny,
                            StepWithoutMotionHasTheStressOfItsEnds,
                            MassIsSymmetricPositiveAndComplete, KernelsAllocateNothing,
                            InvertedInputHasAVerdict);

}  // namespace culm::kit
