#include <culm/joint/cylindrical_joint.hpp>
#include <culm/joint/joint_angle.hpp>
#include <culm/joint/planar_support.hpp>
#include <culm/joint/prismatic_joint.hpp>
#include <culm/joint/revolute_joint.hpp>
#include <culm/joint/revolute_support.hpp>
#include <culm/joint/rigid_support.hpp>
#include <culm/joint/rotation.hpp>
#include <culm/joint/simple_support.hpp>
#include <culm/joint/simple_support_local.hpp>
#include <culm/joint/spherical_joint.hpp>
#include <culm/joint/spherical_support.hpp>
#include <culm/joint/universal_joint.hpp>
#include <culm/joint/weld.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/constraint_contract.hpp>

namespace culm::joint {
namespace {

using model::Constraint;
using model::NodeTable;

const Vec3 oblique = Vec3(0.6, -0.3, 0.8).normalized();
const Vec3 offset(0.2, -0.5, 0.3);

Prescribed quadratic(double amount) {
  return {amount, model::Amplitude::of_time([](double t) { return t * t; })};
}

template <bool Eliminated>
struct SupportCase {
  static constexpr int num_nodes = 1;
  static constexpr bool eliminated = Eliminated;
};

struct Rigid : SupportCase<true> {
  static Constraint make(const NodeTable& nodes) { return rigid_support(nodes, 0); }
};
struct Spherical : SupportCase<true> {
  static Constraint make(const NodeTable& n) { return spherical_support(n, 0, Vec3::Zero()); }
};
struct SphericalWithOffset : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return spherical_support(n, 0, offset); }
};
struct SimpleAlongAxis : SupportCase<true> {
  static Constraint make(const NodeTable& n) {
    return simple_support(n, 0, -Vec3::UnitY(), Vec3::Zero());
  }
};
struct SimpleOblique : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return simple_support(n, 0, oblique, Vec3::Zero()); }
};
struct SimpleWithOffset : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return simple_support(n, 0, Vec3::UnitY(), offset); }
};
struct SimpleMoving : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support(n, 0, Vec3::UnitY(), Vec3::Zero(), quadratic(0.8));
  }
};
struct SimpleLocal : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support_local(n, 0, oblique, quadratic(0.8));
  }
};
struct Revolute : SupportCase<true> {
  static Constraint make(const NodeTable& n) {
    return revolute_support(n, 0, Vec3::UnitZ(), Vec3::Zero());
  }
};
struct RevoluteOblique : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return revolute_support(n, 0, oblique, offset); }
};
struct Planar : SupportCase<true> {
  static Constraint make(const NodeTable& n) { return planar_support(n, 0, Vec3::UnitX()); }
};
struct PlanarOblique : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return planar_support(n, 0, oblique); }
};
struct Turning : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return rotation(n, 0, oblique, quadratic(2.0)); }
};
struct TurningLocal : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return rotation_local(n, 0, oblique, quadratic(2.0));
  }
};
struct RigidLink {
  static constexpr int num_nodes = 2;
  static constexpr bool eliminated = true;
  static Constraint make(const NodeTable& nodes) {
    model::Model model;
    for (int node : {0, 1}) model.nodes().add(NodeTable::slots(nodes.reference(), node));
    model.add_rigid_link("link", 1, 0);
    return model.constraints().front();
  }
};

struct PairCase {
  static constexpr int num_nodes = 2;
  static constexpr bool eliminated = false;
  static NodePair pair(const NodeTable& nodes) { return {nodes, 0, 1, offset}; }
};
struct Ball : PairCase {
  static Constraint make(const NodeTable& n) { return spherical_joint(pair(n)); }
};
struct Hinge : PairCase {
  static Constraint make(const NodeTable& n) { return revolute_joint(pair(n), oblique); }
};
struct Cylinder : PairCase {
  static Constraint make(const NodeTable& n) { return cylindrical_joint(pair(n), oblique); }
};
struct Slider : PairCase {
  static Constraint make(const NodeTable& n) { return prismatic_joint(pair(n), oblique); }
};
struct Cardan : PairCase {
  static Constraint make(const NodeTable& n) {
    return universal_joint(pair(n), oblique, any_normal(oblique));
  }
};
struct Welded : PairCase {
  static Constraint make(const NodeTable& n) { return weld(pair(n)); }
};
struct Angle : PairCase {
  static Constraint make(const NodeTable& n) {
    return joint_angle(pair(n), oblique, quadratic(2.0));
  }
};

using Joints = testing::Types<Ball, Hinge, Cylinder, Slider, Cardan, Welded, Angle>;
using Cases = testing::Types<Rigid, Spherical, SphericalWithOffset, SimpleAlongAxis, SimpleOblique,
                             SimpleWithOffset, SimpleMoving, SimpleLocal, Revolute, RevoluteOblique,
                             Planar, PlanarOblique, Turning, TurningLocal, RigidLink>;

}  // namespace
}  // namespace culm::joint

namespace culm::kit {
INSTANTIATE_TYPED_TEST_SUITE_P(Joint, ConstraintContract, joint::Cases);
INSTANTIATE_TYPED_TEST_SUITE_P(Joint, JointContract, testing::Types<joint::RigidLink>);
INSTANTIATE_TYPED_TEST_SUITE_P(Pair, ConstraintContract, joint::Joints);
INSTANTIATE_TYPED_TEST_SUITE_P(Pair, JointContract, joint::Joints);
}  // namespace culm::kit
