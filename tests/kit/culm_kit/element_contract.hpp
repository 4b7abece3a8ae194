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
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace culm::kit {

/// The laws themselves, for any element.
class ElementLaws : public ElementFixture {
 protected:
  using ElementFixture::ElementFixture;

  void gradient_is_derivative_of_strain() const {
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::MatrixXd B = element.gradient(p, q_any);
      // a quadratic form has no higher derivatives, hence the large step
      const Eigen::MatrixXd difference = any_central_difference(
          [&](const Eigen::VectorXd& q) { return element.strain(p, unflat(q)); }, flat(q_any), 1.0);
      EXPECT_LT(relative_difference(difference, B.transpose()), 1e-14) << "point " << p;
    }
  }

  void curvature_is_derivative_of_gradient() const {
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::MatrixXd A = element.curvature(p, S_random);
      const Eigen::MatrixXd K = any_central_difference(
          [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
            return element.gradient(p, unflat(q)) * S_random;
          },
          flat(q_any), 1.0);
      for (Eigen::Index s = 0; s < A.rows(); ++s) {
        for (Eigen::Index t = 0; t < A.cols(); ++t) {
          const Mat3 block = K.block<3, 3>(3 * s, 3 * t);
          EXPECT_LT(largest(block - A(s, t) * Mat3::Identity()), 1e-14 * largest(K))
              << "point " << p << ", slots " << s << ", " << t;
        }
      }
    }
  }

  void strain_increment_is_midpoint_gradient_times_motion() const {
    const AnySlots mid = 0.5 * (q0 + q1);
    const Eigen::VectorXd dq = flat(q1 - q0);
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::MatrixXd B = element.gradient(p, mid);
      const Eigen::VectorXd defect =
          element.strain(p, q1) - element.strain(p, q0) - B.transpose() * dq;
      const double scale = (B.cwiseAbs().transpose() * dq.cwiseAbs()).maxCoeff();
      EXPECT_LT(largest(defect), 1e-14 * scale) << "point " << p;
    }
  }

  void strain_ignores_rigid_motion() const {
    const RigidMotion motion = RigidMotion::random(3);
    for (const AnySlots& q : {q0, q_any}) {
      for (int p = 0; p < element.num_points(); ++p) {
        const Eigen::VectorXd y = element.strain(p, q);
        const Eigen::VectorXd change = element.strain(p, element.move(motion, q)) - y;
        EXPECT_LT(largest(change), 1e-14 * (10.0 + largest(y)));
      }
    }
  }

  void rigidly_moved_reference_is_stress_free() const {
    const AnySlots q = element.move(RigidMotion::random(4), element.reference());
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::VectorXd y = element.strain(p, q);
      EXPECT_LT(largest(y), 1e-14);
      EXPECT_LT(element.energy(p, y), 1e-26);
      const auto answer = respond(p, y, y, Stencil::statics());
      EXPECT_LT(largest(answer.stress), 1e-14 * largest(answer.tangent) * static_cast<double>(M));
    }
  }

  void stresses_exert_no_force_and_no_moment() const {
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::MatrixXd B = element.gradient(p, q_any);
      const double scale = (B.cwiseAbs() * S_random.cwiseAbs()).sum();
      expect_no_resultant(B * S_random, q_any, scale);
    }
  }

  void stress_is_energy_derivative() const {
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::VectorXd y = element.strain(p, q1);
      const Eigen::VectorXd stress =
          respond(p, element.strain(p, q0), y, Stencil::statics()).stress;
      const Eigen::MatrixXd difference = any_central_difference(
          [&](const Eigen::VectorXd& at) {
            return Eigen::VectorXd::Constant(1, element.energy(p, at)).eval();
          },
          y);
      EXPECT_LT(relative_difference(difference.transpose(), stress), 2e-9);
    }
  }

  void tangent_is_stress_derivative() const {
    for (const Stencil& stencil : element_stencils) {
      for (int p = 0; p < element.num_points(); ++p) {
        const Eigen::VectorXd prev = element.strain(p, q0);
        const Eigen::VectorXd next = element.strain(p, q1);
        const Eigen::MatrixXd difference = any_central_difference(
            [&](const Eigen::VectorXd& y) { return respond(p, prev, y, stencil).stress; }, next);
        EXPECT_LT(relative_difference(difference, respond(p, prev, next, stencil).tangent), 2e-9)
            << "theta " << stencil.theta << ", strain " << stencil.theta_strain;
      }
    }
  }

  void midpoint_force_does_the_stored_work() const {
    const AnySlots mid = 0.5 * (q0 + q1);
    const Eigen::VectorXd dq = flat(q1 - q0);
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::VectorXd prev = element.strain(p, q0);
      const Eigen::VectorXd next = element.strain(p, q1);
      const Eigen::VectorXd stress = respond(p, prev, next, Stencil::midpoint(0.1)).stress;
      const double stored = element.energy(p, next) - element.energy(p, prev);
      const double scale = element.energy(p, next) + element.energy(p, prev);
      EXPECT_NEAR(stress.dot(next - prev), stored, 1e-13 * scale);
      EXPECT_NEAR((element.gradient(p, mid) * stress).dot(dq), stored, 1e-13 * scale);
    }
  }

  void dissipation_takes_energy_and_never_gives_any() const {
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::VectorXd prev = element.strain(p, q0);
      const Eigen::VectorXd next = element.strain(p, q1);
      const double stored = element.energy(p, next) - element.energy(p, prev);
      double less = 0.0;
      for (const double theta_strain : {0.6, 0.75, 1.0}) {
        const Eigen::VectorXd stress = respond(p, prev, next, {0.1, 0.5, theta_strain}).stress;
        const double lost = stress.dot(next - prev) - stored;
        EXPECT_GT(lost, less);
        less = lost;
      }
    }
  }

  void step_without_motion_has_the_stress_of_its_ends() const {
    for (int p = 0; p < element.num_points(); ++p) {
      const Eigen::VectorXd y = element.strain(p, q1);
      const Eigen::VectorXd still = respond(p, y, y, Stencil::midpoint(0.1)).stress;
      const Eigen::VectorXd at_rest = respond(p, y, y, Stencil::statics()).stress;
      EXPECT_LT(relative_difference(still, at_rest), 1e-14);
    }
  }

  void mass_is_symmetric_positive_and_complete() const {
    const Eigen::MatrixXd Mh = element.mass();
    EXPECT_LT(largest(Mh - Mh.transpose()), 1e-15 * largest(Mh));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Mh);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-14 * eigen.eigenvalues().maxCoeff());
    double total = 0.0;
    for (Eigen::Index s = 0; s < Mh.rows(); s += element.slots_per_node()) {
      for (Eigen::Index t = 0; t < Mh.cols(); t += element.slots_per_node()) total += Mh(s, t);
    }
    EXPECT_NEAR(total, element.total_mass(), 1e-13 * element.total_mass());
  }

  void kernels_allocate_nothing() const {
    EXPECT_TRUE(std::isfinite(element.call_all_without_heap(q1)));
  }

  void inverted_input_has_a_verdict() const {
    if (const auto inverted = element.inverted()) {
      const Eigen::VectorXd y = element.strain(0, *inverted);
      for (const Stencil& stencil : element_stencils) {
        const auto answer = element.respond(0, element.strain(0, q0), y, stencil);
        EXPECT_EQ(answer.verdict, Verdict::inverted_element);
        EXPECT_TRUE(answer.stress.allFinite());
      }
      EXPECT_TRUE(std::isnan(element.energy(0, y)));
    } else {
      // a linear law on quadratic forms answers every configuration
      const Eigen::VectorXd y = element.strain(0, -q_any);
      EXPECT_EQ(element.respond(0, y, y, Stencil::statics()).verdict, Verdict::ok);
    }
  }
};

/// The laws for the element of a case.
template <class Case>
class ElementContract : public ElementLaws {
 protected:
  ElementContract() : ElementLaws(std::make_unique<ElementOf<Case>>()) {}
};

TYPED_TEST_SUITE_P(ElementContract);

TYPED_TEST_P(ElementContract, GradientIsDerivativeOfStrain) {
  this->gradient_is_derivative_of_strain();
}
TYPED_TEST_P(ElementContract, CurvatureIsDerivativeOfGradient) {
  this->curvature_is_derivative_of_gradient();
}
TYPED_TEST_P(ElementContract, StrainIncrementIsMidpointGradientTimesMotion) {
  this->strain_increment_is_midpoint_gradient_times_motion();
}
TYPED_TEST_P(ElementContract, StrainIgnoresRigidMotion) { this->strain_ignores_rigid_motion(); }
TYPED_TEST_P(ElementContract, RigidlyMovedReferenceIsStressFree) {
  this->rigidly_moved_reference_is_stress_free();
}
TYPED_TEST_P(ElementContract, StressesExertNoForceAndNoMoment) {
  this->stresses_exert_no_force_and_no_moment();
}
TYPED_TEST_P(ElementContract, StressIsEnergyDerivative) { this->stress_is_energy_derivative(); }
TYPED_TEST_P(ElementContract, TangentIsStressDerivative) { this->tangent_is_stress_derivative(); }
TYPED_TEST_P(ElementContract, MidpointForceDoesTheStoredWork) {
  this->midpoint_force_does_the_stored_work();
}
TYPED_TEST_P(ElementContract, DissipationTakesEnergyAndNeverGivesAny) {
  this->dissipation_takes_energy_and_never_gives_any();
}
TYPED_TEST_P(ElementContract, StepWithoutMotionHasTheStressOfItsEnds) {
  this->step_without_motion_has_the_stress_of_its_ends();
}
TYPED_TEST_P(ElementContract, MassIsSymmetricPositiveAndComplete) {
  this->mass_is_symmetric_positive_and_complete();
}
TYPED_TEST_P(ElementContract, KernelsAllocateNothing) { this->kernels_allocate_nothing(); }
TYPED_TEST_P(ElementContract, InvertedInputHasAVerdict) { this->inverted_input_has_a_verdict(); }

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
