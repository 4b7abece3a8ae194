// Strips in a frame that turns with them.
#include <culm/base/error.hpp>
#include <culm/model/steady_rotation.hpp>

#include "strip_kit.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

namespace culm::strip {
namespace {

using test::Bent;
using test::effect;

class Frame final : public model::SteadyRotation {
 public:
  Frame(Vec3 axis, Vec3 point, double speed)
      : axis_(std::move(axis)), point_(std::move(point)), speed_(speed) {}
  const Vec3& axis() const override { return axis_; }
  const Vec3& point() const override { return point_; }
  double speed(const model::State&, const Stencil&) const override { return speed_; }
  bool turns(int) const override { return true; }

 private:
  Vec3 axis_, point_;
  double speed_;
};

const Vec3 wind(3.0, 7.0, -2.0);
const Vec3 point(0.4, -0.3, 0.2);
constexpr double omega = 1.7;

std::unique_ptr<StripLoad> strips(const model::NodeTable& nodes, int node) {
  auto load =
      std::make_unique<StripLoad>(effect, nodes, model::Amplitude::constant(),
                                  std::make_shared<test::Wind>(1.2, wind), StripModel{{}, true});
  Station station = test::section(1.3, 0.4, std::make_shared<Bent>());
  station.point = model::marker_at(node);
  station.next_airfoil = station.airfoil;
  load->add(std::move(station));
  return load;
}

TEST(StripInFrame, TangentIsDerivativeOfResidual) {
  const Frame frame(wind.normalized(), point, omega);
  const auto fill = [&](model::Model& model) {
    for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
    auto load = strips(model.nodes(), 1);
    load->stand_in(frame, {});
    model.add_load(std::move(load));
  };
  kit::expect_tangent_is_derivative(fill, effect, 1e-4);
  kit::expect_no_allocation(fill, effect);
}

// The same section, at rest in the frame and in a motion in space by the frame's rotation.
TEST(StripInFrame, FeelsWhatItFeelsInSpace) {
  const Frame frame(wind.normalized(), point, omega);
  const model::NodeSlots placed = kit::random_node(4);
  constexpr double h = 1e-3;
  const auto force = [&](bool in_frame) -> Vec<12> {
    model::Model model;
    model.nodes().add(placed);
    auto load = strips(model.nodes(), 0);
    if (in_frame) load->stand_in(frame, {});
    model::Batch* batch = load.get();
    model.add_load(std::move(load));
    model.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model);
    model::State state = model.initial_state();
    state.velocity.assign(state.prev.size(), 0.0);
    state.acceleration_offset.assign(state.prev.size(), 0.0);
    Stencil stencil = Stencil::statics();
    if (!in_frame) {  // from half a step before to half a step after
      stencil = Stencil::midpoint(h);
      const Mat3 spin = omega * skew(frame.axis());
      for (const double side : {-0.5, 0.5}) {
        const Mat3 turn = Eigen::AngleAxisd(side * omega * h, frame.axis()).matrix();
        model::NodeSlots slots = placed;
        slots.col(0) -= point;
        slots = (turn * slots).eval();
        const model::NodeSlots velocity = spin * slots;
        slots.col(0) += point;
        auto& q = side < 0.0 ? state.prev : state.next;
        model::NodeTable::slots(q, 0) = slots;
        if (side > 0.0) continue;
        model::NodeTable::slots(state.velocity, 0) = velocity;
        model::NodeTable::slots(state.acceleration_offset, 0) = -2.0 / h * velocity;
      }
      state.time = state.time_prev + h;
    }
    dense.prepare(state, stencil);
    return dense.residual(state, stencil, {batch}).head<12>();
  };
  const Vec<12> in_space = force(false);
  EXPECT_LT((force(true) - in_space).norm(), 1e-5 * in_space.norm());
}

TEST(StripInFrame, WindThatDoesNotTurnWithItIsRefused) {
  const Frame frame(Vec3::UnitX(), point, omega);
  const auto prepare = [&](const model::SteadyRotation& rotation) {
    model::Model model;
    model.nodes().add(kit::random_node(4));
    auto load = strips(model.nodes(), 0);
    load->stand_in(rotation, {"deck.xml", 7, "Loads / air / Flow"});
    model.add_load(std::move(load));
    model.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model);
    model::State state = model.initial_state();
    dense.prepare(state, Stencil::statics());
  };
  try {
    prepare(frame);
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("its wind is not the same from all sides"), std::string::npos) << text;
    EXPECT_NE(text.find("deck.xml:7"), std::string::npos) << text;
  }
  EXPECT_NO_THROW(prepare(Frame(Vec3::UnitX(), point, 0.0)));  // it stands
  EXPECT_NO_THROW(prepare(Frame(wind.normalized(), point, omega)));
}

}  // namespace
}  // namespace culm::strip
