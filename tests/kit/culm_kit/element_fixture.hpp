/// What the laws of element_contract.hpp start from.
#pragma once

#include <culm/mechanics/element.hpp>

#include <culm_kit/no_heap.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>

namespace culm::kit {

/// Slots of an element as columns, shape (3, S).
using AnySlots = Eigen::Matrix3Xd;

/// The steps of statics, of the conserving scheme, and with half and full numerical dissipation.
inline constexpr Stencil element_stencils[] = {
    Stencil::statics(), Stencil::midpoint(0.1), {0.1, 0.5, 0.75}, {0.1, 0.5, 1.0}};

/// An element made by a case, its kernels with values of dynamic size as results: the laws compile
/// once for all elements.
class AnyElement {
 public:
  struct Answer {
    Verdict verdict;
    Eigen::VectorXd stress;
    Eigen::MatrixXd tangent;
  };

  virtual ~AnyElement() = default;

  virtual int num_points() const = 0;
  virtual int num_strains() const = 0;
  virtual int slots_per_node() const = 0;

  virtual AnySlots reference() const = 0;
  virtual AnySlots state(int seed) const = 0;
  /// Beyond the element's range, where it has an end.
  virtual std::optional<AnySlots> inverted() const = 0;
  virtual double total_mass() const = 0;

  virtual AnySlots move(const RigidMotion& motion, const AnySlots& q) const = 0;
  virtual Eigen::VectorXd strain(int point, const AnySlots& q) const = 0;
  /// Shape (3 S, M).
  virtual Eigen::MatrixXd gradient(int point, const AnySlots& q) const = 0;
  virtual Eigen::MatrixXd curvature(int point, const Eigen::VectorXd& stress) const = 0;
  virtual Answer respond(int point, const Eigen::VectorXd& prev, const Eigen::VectorXd& next,
                         const Stencil& stencil) const = 0;
  virtual double energy(int point, const Eigen::VectorXd& strain) const = 0;
  virtual Eigen::MatrixXd mass() const = 0;
  /// Calls all kernels, none of which may allocate. @return a sum of all results
  virtual double call_all_without_heap(const AnySlots& q) const = 0;
};

/// The element of a case, see element_contract.hpp.
template <class Case>
class ElementOf final : public AnyElement {
 public:
  using E = typename Case::Type;
  static_assert(Element<E>);
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;

  int num_points() const override { return E::num_points; }
  int num_strains() const override { return M; }
  int slots_per_node() const override { return slots_of(E::node_kind); }

  AnySlots reference() const override { return Case::reference(); }
  AnySlots state(int seed) const override { return Case::state(seed); }
  std::optional<AnySlots> inverted() const override {
    if constexpr (requires { Case::inverted(); }) {
      return AnySlots(Case::inverted());
    } else {
      return std::nullopt;
    }
  }
  double total_mass() const override { return Case::total_mass(); }

  AnySlots move(const RigidMotion& motion, const AnySlots& q) const override {
    return motion(Slots<S>(q), E::node_kind);
  }
  Eigen::VectorXd strain(int point, const AnySlots& q) const override {
    Vec<M> y;
    element_.strain(point, q, y);
    return y;
  }
  Eigen::MatrixXd gradient(int point, const AnySlots& q) const override {
    Gradient<S, M> B;
    B.setConstant(1e30);  // must be overwritten
    element_.gradient(point, q, B);
    return B;
  }
  Eigen::MatrixXd curvature(int point, const Eigen::VectorXd& stress) const override {
    SlotMatrix<S> A = SlotMatrix<S>::Constant(1.0);  // it is added to
    element_.add_curvature(point, stress, A);
    A.array() -= 1.0;
    return A;
  }
  Answer respond(int point, const Eigen::VectorXd& prev, const Eigen::VectorXd& next,
                 const Stencil& stencil) const override {
    Response<M> response;
    const Verdict verdict = element_.respond(point, prev, next, stencil, response);
    return {verdict, response.stress, response.tangent};
  }
  double energy(int point, const Eigen::VectorXd& strain) const override {
    return element_.energy(point, strain);
  }
  Eigen::MatrixXd mass() const override { return element_.mass(); }

  double call_all_without_heap(const AnySlots& any) const override {
    const Slots<S> q = any;
    Vec<M> y;
    Gradient<S, M> B;
    SlotMatrix<S> A = SlotMatrix<S>::Zero();
    Response<M> response;
    double sum = 0.0;
    const NoHeap guard;
    for (int p = 0; p < E::num_points; ++p) {
      element_.strain(p, q, y);
      element_.gradient(p, q, B);
      element_.add_curvature(p, y, A);
      for (const Stencil& stencil : element_stencils) {
        element_.respond(p, y, y, stencil, response);
        sum += response.stress.sum() + response.tangent.sum();
      }
      sum += B.sum() + A.sum() + element_.energy(p, y);
    }
    return sum + element_.mass().sum();
  }

 private:
  const E element_ = Case::make();
};

/// Two admissible states of an element, and one that is anything.
class ElementFixture : public testing::Test {
 protected:
  explicit ElementFixture(std::unique_ptr<AnyElement> any)
      : owned(std::move(any)),
        element(*owned),
        M(element.num_strains()),
        q0(element.state(1)),
        q1(element.state(2)),
        N(q0.size()),
        S_random(random_matrix(5, M, 1)),
        q_any(q0 + 0.3 * random_matrix(7, 3, q0.cols())) {}

  const std::unique_ptr<AnyElement> owned;
  const AnyElement& element;
  const Eigen::Index M;  // forms per point
  const AnySlots q0;
  const AnySlots q1;
  const Eigen::Index N;  // components of all slots
  const Eigen::VectorXd S_random;
  // anything, admissible or not: for the laws that hold at every q
  const AnySlots q_any;

  static Eigen::VectorXd flat(const AnySlots& q) {
    return Eigen::Map<const Eigen::VectorXd>(q.data(), q.size());
  }
  static AnySlots unflat(const Eigen::VectorXd& v) {
    return Eigen::Map<const AnySlots>(v.data(), 3, v.size() / 3);
  }
  static double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

  AnyElement::Answer respond(int point, const Eigen::VectorXd& prev, const Eigen::VectorXd& next,
                             const Stencil& stencil) const {
    AnyElement::Answer answer = element.respond(point, prev, next, stencil);
    EXPECT_EQ(answer.verdict, Verdict::ok);
    return answer;
  }

  // What stress S does on the slots of a point: resultant force, and moment about the origin.
  void expect_no_resultant(const Eigen::VectorXd& f, const AnySlots& q, double scale) const {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (Eigen::Index s = 0; s < q.cols(); ++s) {
      const Vec3 f_s = f.segment<3>(3 * s);
      if (s % element.slots_per_node() == 0) force += f_s;
      moment += Vec3(q.col(s)).cross(f_s);
    }
    EXPECT_LT(force.norm(), 1e-14 * scale);
    EXPECT_LT(moment.norm(), 1e-14 * scale * (1.0 + largest(q)));
  }

 private:
  static Eigen::MatrixXd random_matrix(int seed, Eigen::Index rows, Eigen::Index columns) {
    Random random(seed);
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.number(); });
  }
};

}  // namespace culm::kit
