#include <culm/load/pressure_load.hpp>

#include "sample_load.hpp"

#include <Eigen/Geometry>
#include <culm_kit/load_contract.hpp>

#include <cmath>
#include <memory>

namespace culm::load {
namespace {

using kit::Resultant;
using model::Coordinates;
using model::NodeTable;

/// Between nodes, off their axis, as the points of a line are.
model::Marker point_on(int num_nodes) {
  model::Marker point;
  for (int node = 0; node < num_nodes; ++node) point.nodes.push_back(node);
  point.weights = num_nodes == 1   ? std::vector{1.0}
                  : num_nodes == 2 ? std::vector{0.3, 0.7}
                                   : std::vector{-0.1, 0.4, 0.6, 0.1};
  point.offset = offset;
  return point;
}

template <int Nodes, Axes F>
struct ForceCase {
  static constexpr int num_nodes = Nodes;
  static constexpr bool follows = F == Axes::directors;

  static std::unique_ptr<model::Batch> make(const NodeTable& nodes,
                                            const model::Amplitude& amplitude) {
    auto load = std::make_unique<SlotLoad>("Force", nodes, amplitude);
    load->add_force(point_on(Nodes), components, F);
    return load;
  }
  static Resultant resultant(const Coordinates& q) {
    const model::Marker point = point_on(Nodes);
    Vec3 x = Vec3::Zero();
    Mat3 triad = Mat3::Zero();
    for (int node = 0; node < Nodes; ++node) {
      const auto slots = NodeTable::slots(q, node);
      const double weight = point.weights[static_cast<std::size_t>(node)];
      x += weight * (slots.col(0) + slots.rightCols<3>() * offset);
      triad += weight * slots.rightCols<3>();
    }
    const Vec3 force = follows ? Vec3(triad * components) : components;
    return {force, x.cross(force)};
  }
};

/// At the node itself: no arm, hence no stiffness of a dead force.
struct CentralForceCase {
  static constexpr int num_nodes = 1;
  static constexpr bool follows = false;
  static std::unique_ptr<model::Batch> make(const NodeTable& nodes,
                                            const model::Amplitude& amplitude) {
    auto load = std::make_unique<SlotLoad>("Force", nodes, amplitude);
    load->add_force(model::marker_at(0), components, Axes::space);
    return load;
  }
  static Resultant resultant(const Coordinates& q) {
    return {components, NodeTable::slots(q, 0).col(0).cross(components)};
  }
};

/// Two items of one batch that share a node.
struct TwoForcesCase {
  static constexpr int num_nodes = 2;
  static constexpr bool follows = true;
  static std::unique_ptr<model::Batch> make(const NodeTable& nodes,
                                            const model::Amplitude& amplitude) {
    auto load = std::make_unique<SlotLoad>("Force", nodes, amplitude);
    load->add_force(point_on(2), components, Axes::directors);
    load->add_force(point_on(1), 2.0 * components, Axes::directors);
    return load;
  }
  static Resultant resultant(const Coordinates& q) {
    const Resultant a = ForceCase<2, Axes::directors>::resultant(q);
    const Resultant b = ForceCase<1, Axes::directors>::resultant(q);
    return {a.force + 2.0 * b.force, a.moment + 2.0 * b.moment};
  }
};

template <Axes F>
struct MomentCase {
  static constexpr int num_nodes = 1;
  static constexpr bool follows = F == Axes::directors;
  static std::unique_ptr<model::Batch> make(const NodeTable& nodes,
                                            const model::Amplitude& amplitude) {
    auto load = std::make_unique<MomentLoad>("Moment", nodes, amplitude, F);
    load->add_moment(0, components);
    return load;
  }
  static Resultant resultant(const Coordinates& q) {
    const Mat3 triad = NodeTable::slots(q, 0).rightCols<3>();
    return {Vec3::Zero(), follows ? Vec3(triad * components) : components};
  }
};

/// On a face of shell nodes.
struct PressureCase {
  static constexpr NodeKind node_kind(int) { return NodeKind::node6; }
  static constexpr int num_nodes = 4;
  static constexpr bool follows = true;
  static constexpr double zeta = 0.3;
  static constexpr double pressure = 1.7;
  static std::unique_ptr<model::Batch> make(const NodeTable& nodes,
                                            const model::Amplitude& amplitude) {
    auto load = std::make_unique<PressureLoad>("Pressure", nodes, amplitude);
    load->add_face({0, 1, 2, 3}, zeta, pressure);
    return load;
  }
  /// By three Gauss points in each direction, of which the load takes two.
  static Resultant resultant(const Coordinates& q) {
    const double at[] = {-std::sqrt(0.6), 0.0, std::sqrt(0.6)};
    const double weight[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    const double xi_a[] = {-1.0, 1.0, 1.0, -1.0};
    const double eta_a[] = {-1.0, -1.0, 1.0, 1.0};
    Resultant total;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        Vec3 x = Vec3::Zero();
        Vec3 g1 = Vec3::Zero();
        Vec3 g2 = Vec3::Zero();
        for (int a = 0; a < 4; ++a) {
          const auto slots = NodeTable::slots(q, a);
          const Vec3 corner = slots.col(0) + zeta * slots.col(1);
          x += 0.25 * (1.0 + xi_a[a] * at[i]) * (1.0 + eta_a[a] * at[j]) * corner;
          g1 += 0.25 * xi_a[a] * (1.0 + eta_a[a] * at[j]) * corner;
          g2 += 0.25 * eta_a[a] * (1.0 + xi_a[a] * at[i]) * corner;
        }
        const Vec3 force = weight[i] * weight[j] * pressure * g1.cross(g2);
        total.force += force;
        total.moment += x.cross(force);
      }
    }
    return total;
  }
};

/// Forces at a point above shell nodes.
template <Axes F>
struct ShellForceCase {
  static constexpr NodeKind node_kind(int) { return NodeKind::node6; }
  static constexpr int num_nodes = 4;
  static constexpr bool follows = F == Axes::directors;
  static model::Marker point() { return {{0, 1, 2, 3}, {0.1, 0.2, 0.3, 0.4}, 0.3 * Vec3::UnitX()}; }
  static std::unique_ptr<model::Batch> make(const NodeTable& nodes,
                                            const model::Amplitude& amplitude) {
    auto load = std::make_unique<SlotLoad>("Force", nodes, amplitude);
    load->add_force(point(), follows ? Vec3(2.0 * Vec3::UnitX()) : components, F);
    return load;
  }
  static Resultant resultant(const Coordinates& q) {
    Vec3 x = Vec3::Zero();
    Vec3 d = Vec3::Zero();
    for (int node = 0; node < num_nodes; ++node) {
      const double weight = point().weights[static_cast<std::size_t>(node)];
      x += weight * (NodeTable::slots(q, node).col(0) + 0.3 * NodeTable::slots(q, node).col(1));
      d += weight * NodeTable::slots(q, node).col(1);
    }
    const Vec3 force = follows ? Vec3(2.0 * d) : components;
    return {force, x.cross(force)};
  }
};

using Cases =
    testing::Types<CentralForceCase, ForceCase<1, Axes::space>, ForceCase<2, Axes::space>,
                   ForceCase<4, Axes::space>, ForceCase<1, Axes::directors>,
                   ForceCase<2, Axes::directors>, ForceCase<4, Axes::directors>, TwoForcesCase,
                   MomentCase<Axes::space>, MomentCase<Axes::directors>, PressureCase,
                   ShellForceCase<Axes::space>, ShellForceCase<Axes::directors>>;

}  // namespace
}  // namespace culm::load

namespace culm::kit {
INSTANTIATE_TYPED_TEST_SUITE_P(Load, LoadContract, load::Cases);
}
