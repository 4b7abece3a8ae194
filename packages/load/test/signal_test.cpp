// Loads that follow signals: the tangent knows how forces change with them.
#include <culm/load/link_load.hpp>
#include <culm/load/moment_load.hpp>
#include <culm/load/slot_load.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

namespace culm::load {
namespace {

constexpr const char* effect = "tested";
const Vec3 components(0.4, -1.1, 0.7);

using Make = std::function<std::unique_ptr<model::Batch>(const model::NodeTable& nodes,
                                                         const model::Amplitude& amplitude)>;

struct Follower {
  std::string name;
  Make make;
  NodeKind kind = NodeKind::node12;
};

Make force(Axes axes) {
  return [=](const model::NodeTable& nodes, const model::Amplitude& amplitude) {
    auto load = std::make_unique<SlotLoad>(effect, nodes, amplitude);
    model::Marker point = model::marker_at(0);
    if (nodes.kind(0) == NodeKind::node12) point.offset = Vec3(0.3, 0.1, -0.2);
    load->add_force(point, components, axes);
    return load;
  };
}

Make moment(Axes axes) {
  return [=](const model::NodeTable& nodes, const model::Amplitude& amplitude) {
    auto load = std::make_unique<MomentLoad>(effect, nodes, amplitude, axes);
    load->add_moment(0, components);
    return load;
  };
}

std::unique_ptr<model::Batch> drive(const model::NodeTable& nodes,
                                    const model::Amplitude& amplitude) {
  auto load = std::make_unique<LinkLoad>(effect, nodes, std::make_unique<DriveLaw>(1.7, amplitude));
  const joint::MarkerPair pair(nodes, 0, 1, Vec3::Zero());
  load->add(angle_link(pair, components.normalized()));
  return load;
}

class SignalFollowers : public testing::TestWithParam<Follower> {};

TEST_P(SignalFollowers, TangentIsDerivativeOfResidual) {
  for (const auto kind : {model::UnknownKind::algebraic, model::UnknownKind::first_order}) {
    for (const bool with_slave : {false, true}) {
      if (with_slave && GetParam().kind == NodeKind::node6) continue;
      kit::expect_tangent_is_derivative(
          [&](model::Model& model) {
            for (const int seed : {10, 11}) {
              kit::add_random_node(model.nodes(), GetParam().kind, seed);
            }
            const int block = model.add_own_block({"signal", {{"other"}, {"output", kind, 0.6}}});
            const auto amplitude = model::Amplitude::of_signal(model.signal(block, 1));
            model.add_load(GetParam().make(model.nodes(), amplitude));
            if (with_slave) {
              model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
            }
          },
          effect, 1e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Loads, SignalFollowers,
    testing::Values(Follower{"DeadForce", force(Axes::space)},
                    Follower{"FollowerForce", force(Axes::directors)},
                    Follower{"ShellForce", force(Axes::space), NodeKind::node6},
                    Follower{"DeadMoment", moment(Axes::space)},
                    Follower{"FollowerMoment", moment(Axes::directors)},
                    Follower{"ShellMoment", moment(Axes::space), NodeKind::node6},
                    Follower{"Drive", drive}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace culm::load
