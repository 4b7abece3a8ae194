#include <culm/joint/cylindrical_joint.hpp>
#include <culm/joint/joint_angle.hpp>
#include <culm/joint/planar_support.hpp>
#include <culm/joint/prismatic_joint.hpp>
#include <culm/joint/revolute_joint.hpp>
#include <culm/joint/revolute_support.hpp>
#include <culm/joint/rigid_support.hpp>
#include <culm/joint/rotation.hpp>
#include <culm/joint/shell_connection.hpp>
#include <culm/joint/simple_support.hpp>
#include <culm/joint/simple_support_local.hpp>
#include <culm/joint/spherical_joint.hpp>
#include <culm/joint/spherical_support.hpp>
#include <culm/joint/universal_joint.hpp>
#include <culm/joint/weld.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/constraint_contract.hpp>

#include <vector>

namespace culm::joint {
namespace {

using kit::oblique;
using model::Constraint;
using model::NodeTable;

const Vec3 offset(0.2, -0.5, 0.3);

const model::Amplitude square = model::Amplitude::of_time([](double t) { return t * t; });

Prescribed quadratic(double amount) { return {amount, square}; }

template <bool Eliminated>
struct SupportCase {
  static constexpr int num_nodes = 1;
  static constexpr bool eliminated = Eliminated;
};

struct Rigid : SupportCase<true> {
  static Constraint make(const NodeTable& nodes) { return rigid_support({nodes, 0}); }
};
struct Spherical : SupportCase<true> {
  static Constraint make(const NodeTable& n) { return spherical_support({n, 0}, Vec3::Zero()); }
};
struct SphericalMoving : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return spherical_support({n, 0}, offset, {Vec3(0.3, -0.4, 0.2), square});
  }
};
struct RigidMoving : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return rigid_support(
        {n, 0}, {{Vec3(0.3, -0.4, 0.2), square}, oblique, quadratic(2.0), Vec3(0.5, -0.2, 0.9)});
  }
};
struct SphericalWithOffset : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return spherical_support({n, 0}, offset); }
};
struct SimpleAlongAxis : SupportCase<true> {
  static Constraint make(const NodeTable& n) {
    return simple_support({n, 0}, -Vec3::UnitY(), Vec3::Zero());
  }
};
struct SimpleOblique : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support({n, 0}, oblique, Vec3::Zero());
  }
};
struct SimpleWithOffset : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support({n, 0}, Vec3::UnitY(), offset);
  }
};
struct SimpleMoving : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support({n, 0}, Vec3::UnitY(), Vec3::Zero(), quadratic(0.8));
  }
};
struct SimpleLocal : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support_local({n, 0}, oblique, quadratic(0.8));
  }
};
struct Revolute : SupportCase<true> {
  static Constraint make(const NodeTable& n) {
    return revolute_support({n, 0}, Vec3::UnitZ(), Vec3::Zero());
  }
};
struct RevoluteOblique : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return revolute_support({n, 0}, oblique, offset); }
};
struct Planar : SupportCase<true> {
  static Constraint make(const NodeTable& n) { return planar_support({n, 0}, Vec3::UnitX()); }
};
struct PlanarOblique : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return planar_support({n, 0}, oblique); }
};
struct Turning : SupportCase<false> {
  static Constraint make(const NodeTable& n) { return rotation({n, 0}, oblique, quadratic(2.0)); }
};
struct TurningLocal : SupportCase<false> {
  static Constraint make(const NodeTable& n) {
    return rotation_local({n, 0}, oblique, quadratic(2.0));
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
  static MarkerPair pair(const NodeTable& nodes) { return {nodes, 0, 1, offset}; }
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

// Between nodes, where positions and directors are interpolated.
Anchor between(const NodeTable& nodes, int first, int second) {
  return {nodes, model::Marker{{first, second}, {0.3, 0.7}, Vec3::Zero()}};
}

struct BetweenNodes {
  static constexpr int num_nodes = 2;
  static constexpr bool eliminated = false;
};
struct RigidBetween : BetweenNodes {
  static Constraint make(const NodeTable& n) { return rigid_support(between(n, 0, 1)); }
};
struct SphericalBetween : BetweenNodes {
  static Constraint make(const NodeTable& n) { return spherical_support(between(n, 0, 1), offset); }
};
struct SimpleLocalBetween : BetweenNodes {
  static Constraint make(const NodeTable& n) {
    return simple_support_local(between(n, 0, 1), oblique, quadratic(0.8));
  }
};
struct RevoluteBetween : BetweenNodes {
  static Constraint make(const NodeTable& n) {
    return revolute_support(between(n, 0, 1), Vec3::UnitZ(), Vec3::Zero());
  }
};
struct PlanarBetween : BetweenNodes {
  static Constraint make(const NodeTable& n) {
    return planar_support(between(n, 0, 1), Vec3::UnitX());
  }
};
struct TurningBetween : BetweenNodes {
  static Constraint make(const NodeTable& n) {
    return rotation_local(between(n, 0, 1), oblique, quadratic(2.0));
  }
};

// One side between nodes 0 and 2, the other between 1 and 3.
struct PairBetween {
  static constexpr int num_nodes = 4;
  static constexpr bool eliminated = false;
  static MarkerPair pair(const NodeTable& nodes) {
    return {between(nodes, 0, 2), between(nodes, 1, 3), offset};
  }
};
struct BallBetween : PairBetween {
  static Constraint make(const NodeTable& n) { return spherical_joint(pair(n)); }
};
struct HingeBetween : PairBetween {
  static Constraint make(const NodeTable& n) { return revolute_joint(pair(n), oblique); }
};
struct SliderBetween : PairBetween {
  static Constraint make(const NodeTable& n) { return prismatic_joint(pair(n), oblique); }
};
struct WeldedBetween : PairBetween {
  static Constraint make(const NodeTable& n) { return weld(pair(n)); }
};

// On nodes of shells.
template <bool Eliminated>
struct ShellCase : SupportCase<Eliminated> {
  static constexpr NodeKind node_kind(int) { return NodeKind::node6; }
};
const Vec3 along_director(0.3, 0.0, 0.0);

struct RigidShell : ShellCase<true> {
  static Constraint make(const NodeTable& n) { return rigid_support({n, 0}); }
};
struct RigidShellMoving : ShellCase<false> {
  static Constraint make(const NodeTable& n) { return RigidMoving::make(n); }
};
struct SphericalShell : ShellCase<true> {
  static Constraint make(const NodeTable& n) { return Spherical::make(n); }
};
struct SphericalShellWithOffset : ShellCase<false> {
  static Constraint make(const NodeTable& n) { return spherical_support({n, 0}, along_director); }
};
struct SimpleShell : ShellCase<true> {
  static Constraint make(const NodeTable& n) { return SimpleAlongAxis::make(n); }
};
struct SimpleShellWithOffset : ShellCase<false> {
  static Constraint make(const NodeTable& n) {
    return simple_support({n, 0}, oblique, along_director);
  }
};
struct SymmetryShell : ShellCase<true> {
  static Constraint make(const NodeTable& n) { return Planar::make(n); }
};
struct SymmetryShellOblique : ShellCase<false> {
  static Constraint make(const NodeTable& n) { return PlanarOblique::make(n); }
};
struct RevoluteShell : ShellCase<true> {
  static Constraint make(const NodeTable& n) { return Revolute::make(n); }
};
struct RevoluteShellOblique : ShellCase<false> {
  static Constraint make(const NodeTable& n) {
    return revolute_support({n, 0}, oblique, along_director);
  }
};
struct Inextensible : ShellCase<false> {
  static Constraint make(const NodeTable& n) { return inextensible_director(n, 0); }
};

struct DirectorAlongAxis : ShellCase<true> {
  static Constraint make(const NodeTable& n) { return director_support(n, 0, Vec3::UnitY()); }
};
struct DirectorOblique : ShellCase<false> {
  static Constraint make(const NodeTable& n) { return director_support(n, 0, oblique); }
};

struct ShellPair : ShellCase<false> {
  static constexpr int num_nodes = 2;
};
struct ShellHinge : ShellPair {
  static Constraint make(const NodeTable& n) { return hinge_connection(n, 0, 1); }
};
struct ShellFold : ShellPair {
  static Constraint make(const NodeTable& n) { return fold_connection(n, 0, 1); }
};
struct InextensibleFold : ShellPair {
  static Constraint make(const NodeTable& n) { return fold_connection(n, 0, 1, true); }
};
struct Layers : ShellPair {
  static Constraint make(const NodeTable& n) { return layer_connection(n, 0, 1, 0.2, 0.5); }
};

// A node of a shell on a triad.
struct ToTriad {
  static constexpr int num_nodes = 2;
  static constexpr NodeKind node_kind(int node) {
    return node == 0 ? NodeKind::node12 : NodeKind::node6;
  }
};
struct Soft : ToTriad {
  static constexpr bool eliminated = false;
  static Constraint make(const NodeTable& n) { return soft_transition(n, 1, 0); }
};
struct RigidTransition : ToTriad {
  static constexpr bool eliminated = true;
  static Constraint make(const NodeTable& nodes) {
    model::Model model;
    for (int node : {0, 1}) {
      model.nodes().add(NodeTable::slots(nodes.reference(), node), node_kind(node));
    }
    model.add_rigid_link("link", 1, 0);
    return model.constraints().front();
  }
};

using kit::subject;
using Subjects = std::vector<kit::ConstraintSubject>;

const Subjects cases = {
    subject<Rigid>("Rigid"),
    subject<Spherical>("Spherical"),
    subject<SphericalWithOffset>("SphericalWithOffset"),
    subject<SimpleAlongAxis>("SimpleAlongAxis"),
    subject<SimpleOblique>("SimpleOblique"),
    subject<SimpleWithOffset>("SimpleWithOffset"),
    subject<SimpleMoving>("SimpleMoving"),
    subject<SimpleLocal>("SimpleLocal"),
    subject<Revolute>("Revolute"),
    subject<RevoluteOblique>("RevoluteOblique"),
    subject<Planar>("Planar"),
    subject<PlanarOblique>("PlanarOblique"),
    subject<Turning>("Turning"),
    subject<TurningLocal>("TurningLocal"),
    subject<RigidLink>("RigidLink"),
    subject<SphericalMoving>("SphericalMoving"),
    subject<RigidMoving>("RigidMoving"),
    subject<RigidBetween>("RigidBetween"),
    subject<SphericalBetween>("SphericalBetween"),
    subject<SimpleLocalBetween>("SimpleLocalBetween"),
    subject<RevoluteBetween>("RevoluteBetween"),
    subject<PlanarBetween>("PlanarBetween"),
    subject<TurningBetween>("TurningBetween"),
};
const Subjects joints = {
    subject<Ball>("Ball"),
    subject<Hinge>("Hinge"),
    subject<Cylinder>("Cylinder"),
    subject<Slider>("Slider"),
    subject<Cardan>("Cardan"),
    subject<Welded>("Welded"),
    subject<Angle>("Angle"),
    subject<BallBetween>("BallBetween"),
    subject<HingeBetween>("HingeBetween"),
    subject<SliderBetween>("SliderBetween"),
    subject<WeldedBetween>("WeldedBetween"),
};
const Subjects shell_cases = {
    subject<RigidShell>("RigidShell"),
    subject<RigidShellMoving>("RigidShellMoving"),
    subject<SphericalShell>("SphericalShell"),
    subject<SphericalShellWithOffset>("SphericalShellWithOffset"),
    subject<SimpleShell>("SimpleShell"),
    subject<SimpleShellWithOffset>("SimpleShellWithOffset"),
    subject<SymmetryShell>("SymmetryShell"),
    subject<SymmetryShellOblique>("SymmetryShellOblique"),
    subject<RevoluteShell>("RevoluteShell"),
    subject<RevoluteShellOblique>("RevoluteShellOblique"),
    subject<ShellHinge>("ShellHinge"),
    subject<ShellFold>("ShellFold"),
    subject<InextensibleFold>("InextensibleFold"),
    subject<Layers>("Layers"),
    subject<DirectorAlongAxis>("DirectorAlongAxis"),
    subject<DirectorOblique>("DirectorOblique"),
};
const Subjects shell_joints = {
    subject<Inextensible>("Inextensible"),
    subject<Soft>("Soft"),
    subject<RigidTransition>("RigidTransition"),
};

}  // namespace
}  // namespace culm::joint

namespace culm::kit {
INSTANTIATE_TEST_SUITE_P(Joint, ConstraintContract, testing::ValuesIn(joint::cases),
                         name_of_subject);
INSTANTIATE_TEST_SUITE_P(Joint, JointContract,
                         testing::Values(subject<joint::RigidLink>("RigidLink")), name_of_subject);
INSTANTIATE_TEST_SUITE_P(Pair, ConstraintContract, testing::ValuesIn(joint::joints),
                         name_of_subject);
INSTANTIATE_TEST_SUITE_P(Pair, JointContract, testing::ValuesIn(joint::joints), name_of_subject);
INSTANTIATE_TEST_SUITE_P(Shell, ConstraintContract, testing::ValuesIn(joint::shell_cases),
                         name_of_subject);
INSTANTIATE_TEST_SUITE_P(ShellJoint, ConstraintContract, testing::ValuesIn(joint::shell_joints),
                         name_of_subject);
INSTANTIATE_TEST_SUITE_P(ShellJoint, JointContract, testing::ValuesIn(joint::shell_joints),
                         name_of_subject);
}  // namespace culm::kit
