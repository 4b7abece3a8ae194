// Loads that follow signals: the tangent knows how forces change with them.
#include <culm/load/link_load.hpp>

#include "sample_load.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace culm::load {
namespace {

using kit::effect;

struct Follower {
  std::string name;
  Make make;
  NodeKind kind = NodeKind::node12;
};

void PrintTo(const Follower& follower, std::ostream* out) { *out << follower.name; }

std::unique_ptr<model::Batch> drive_between(const model::NodeTable& nodes,
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
    testing::Values(Follower{"DeadForce", force_in(Axes::space)},
                    Follower{"FollowerForce", force_in(Axes::directors)},
                    Follower{"ShellForce", force_in(Axes::space), NodeKind::node6},
                    Follower{"DeadMoment", moment_in(Axes::space)},
                    Follower{"FollowerMoment", moment_in(Axes::directors)},
                    Follower{"ShellMoment", moment_in(Axes::space), NodeKind::node6},
                    Follower{"Drive", drive_between}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace culm::load
