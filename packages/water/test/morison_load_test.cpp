#include <culm/water/dispersion.hpp>

#include "morison_kit.hpp"

#include <cmath>
#include <numbers>

namespace culm::water {
namespace {

using std::numbers::pi;

using test::effect;
using test::make_sea;
using test::member;
using test::MovedMember;
using test::segment;
using test::still_water;

// Everything at once on a cone that the surface cuts, between nodes of a beam and on one.
void fill(model::Model& model, bool with_slave, double level) {
  for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
  const auto amplitude = model::Amplitude::of_time([](double t) { return 1.0 + t; });
  const auto sea = make_sea("Still Water", {{"Depth", 50.0}, {"Level", level}, {"Density", 1.0}});
  auto load =
      std::make_unique<MorisonLoad>(model::Effect("Morison", "tested"), model.nodes(), amplitude,
                                    sea, MorisonModel{true, {0.7, 0.4}, {0.6, 0.8}});
  const WetSection section{0.9, 0.5, 1.1, 0.8, 0.2, 0.3, 1.7};
  Segment one = segment({0.1, 0.2, -0.3}, {0.5, -0.3, 0.4}, 1.0, 0.8);
  for (WetSection& end : one.sections) {
    const double diameter = end.diameter;
    end = section;
    end.diameter = diameter;
  }
  one.faces = {Face::wet, Face::dry};
  load->add(one);
  one.faces = {Face::dry, Face::none};
  one.ends = {model::Marker{{0, 1}, {0.8, 0.2}, Vec3::Zero()},
              model::Marker{{0, 1}, {0.1, 0.9}, Vec3(0.1, 0.0, 0.2)}};
  load->add(one);
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(MorisonLoad, TangentIsDerivativeOfResidual) {
  for (const double level : {0.3, 5.0}) {
    kit::expect_tangent_is_derivative([&](model::Model& model) { fill(model, false, level); },
                                      effect, 1e-4);
  }
  kit::expect_tangent_is_derivative([](model::Model& model) { fill(model, true, 5.0); }, effect,
                                    1e-4);
}

TEST(MorisonLoad, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    kit::expect_residual_is_projected([&](model::Model& model) { fill(model, with_slave, 0.3); },
                                      effect);
  }
}

TEST(MorisonLoad, AssembleAllocatesNothing) {
  kit::expect_no_allocation([](model::Model& model) { fill(model, true, 0.3); }, effect);
}

TEST(MorisonLoad, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([](model::Model& model) { fill(model, false, 0.3); }, effect);
}

// A fixed cylinder from the bed to still water. @source fluids C17
TEST(MorisonLoad, OfWavesOnAFixedCylinder) {
  const double D = 6.0, d = 20.0, a = 3.0, omega = 2.0 * pi / 10.0;
  const double k = wave_number(omega, d, 9.80665);
  WetSection section;
  section.diameter = D;
  section.drag = 1.0;
  section.added_mass = 1.0;
  // at the phases of largest inertia and largest drag
  for (const bool is_drag : {false, true}) {
    const auto sea = make_sea("Regular Waves", {{"Depth", d},
                                                {"Gravity", 9.80665},
                                                {"Height", 2.0 * a},
                                                {"Period", 10.0},
                                                {"Phase", is_drag ? 0.0 : 0.5 * pi},
                                                {"Stretching", std::string("None")}});
    MovedMember pile(member({0, 0, -d}, {0, 0, 5}, section, section, 50), sea, {.buoyancy = false});
    const auto q = MovedMember::placed(Vec3::Zero(), Mat3::Identity());
    const auto found = pile.stand(q);
    const double moment = found.moment[1] + d * found.force[0];  // about the mud line
    const double kd = k * d;
    const double inertia = 1025.0 * 2.0 * 0.25 * pi * D * D * a * omega * omega / k;
    const double drag = 0.5 * 1025.0 * D * std::pow(a * omega / std::sinh(kd), 2) *
                        (0.5 * d + std::sinh(2.0 * kd) / (4.0 * k));
    EXPECT_NEAR(inertia, 1324297.0, 1.0);
    EXPECT_NEAR(drag, 207599.0, 1.0);
    // profiles grow as exp(kz) or exp(2kz); the error of two points in parts of 0.5 m
    const double rest = std::pow((is_drag ? 2.0 : 1.0) * k * 0.5, 4) / 4320.0;
    EXPECT_NEAR(found.force[0] / (is_drag ? drag : inertia), 1.0, rest);
    EXPECT_NEAR(moment, is_drag ? 2416504.0 : 14314150.0, is_drag ? 10.0 : 10.0);
  }
}

std::shared_ptr<const Sea> waves(const std::string& stretching, double phase,
                                 double period = 10.0) {
  return make_sea("Regular Waves", {{"Depth", 20.0},
                                    {"Gravity", 9.80665},
                                    {"Height", 4.0},
                                    {"Period", period},
                                    {"Phase", phase},
                                    {"Stretching", stretching}});
}

WetSection smooth(double diameter) {
  WetSection section;
  section.diameter = diameter;
  return section;
}

// Whatever the theory, phase and tilt: pressure across the axis has no part along it.
TEST(MorisonLoad, OfWavesOnCylindersWithDryFacesIsAcrossThem) {
  const Vec3 axis = Vec3(0.6, 0.3, 1.0).normalized();
  for (const char* stretching : {"None", "Vertical", "Wheeler"}) {
    for (const double phase : {0.0, 0.7, pi}) {
      const auto sea = waves(stretching, phase);
      std::vector<Segment> pile = member({0, 0, -20}, {0, 0, 5}, smooth(6.0), smooth(6.0), 50);
      std::vector<Segment> brace =
          member({1, 2, -15}, Vec3(1, 2, -15) + 10.0 * axis, smooth(1.0), smooth(1.0), 20);
      for (std::vector<Segment>* all : {&pile, &brace}) {
        all->front().faces[0] = all->back().faces[1] = Face::dry;
      }
      const auto q = MovedMember::placed(Vec3::Zero(), Mat3::Identity());
      // two points in parts of 0.5 m, and a surface that is straight within them
      const double rest = 1e-3 * 1025.0 * 9.80665 * 0.25 * pi * 36.0;
      EXPECT_NEAR(MovedMember(pile, sea).stand(q).force[2], 0.0, rest) << stretching << phase;
      EXPECT_NEAR(MovedMember(brace, sea).stand(q).force.dot(axis), 0.0, rest / 36.0)
          << stretching << phase;
    }
  }
}

// Two pieces whose dry faces meet close to still water, one of them tilted a little: what waves
// press on the plane where the theory ends is nobody's, in whichever of them it lies.
TEST(MorisonLoad, OfWavesOnPiecesThatMeetAtStillWaterKnowsNoJoint) {
  const auto sea = waves("None", 0.0);  // 2 m at the crest
  const auto q = MovedMember::placed(Vec3::Zero(), Mat3::Identity());
  const double pressed = 1025.0 * 9.80665 * 2.0 * 0.25 * pi * 36.0;
  const auto stand = [&](double height, double tilt) {
    const Vec3 joint(0, 0, height), top = joint + 5.0 * Vec3(tilt, 0.0, 1.0);
    std::vector<Segment> pile = member({0, 0, -20}, joint, smooth(6.0), smooth(6.0), 40);
    const std::vector<Segment> above = member(joint, top, smooth(6.0), smooth(6.0), 10);
    pile.front().faces[0] = pile.back().faces[1] = Face::dry;
    pile.insert(pile.end(), above.begin(), above.end());
    pile[40].faces[0] = pile.back().faces[1] = Face::dry;
    return MovedMember(pile, sea).stand(q);
  };
  const auto straight = stand(0.0, 0.0);
  for (const double tilt : {1e-6, 2e-5, 1e-4, 1e-2}) {
    for (const double height : {0.0, 1e-7, 0.4 * tilt * 3.0, -0.7 * tilt * 3.0}) {
      const auto found = stand(height, tilt);
      const double rest = 1e-7 + tilt;
      EXPECT_NEAR(found.force[2], straight.force[2], rest * pressed) << tilt << " " << height;
      EXPECT_NEAR(found.moment[1], straight.moment[1], 10.0 * rest * pressed)
          << tilt << " " << height;
    }
  }
}

// Drag and added mass of faces are those of ends, not of cuts where the member goes on.
TEST(MorisonLoad, CutsHaveNoDrag) {
  const double step = 0.1, speed = 2.0;
  const auto from = MovedMember::placed(Vec3::Zero(), Mat3::Identity());
  const auto to = MovedMember::placed(Vec3(0.0, 0.0, step * speed), Mat3::Identity());
  const auto velocity = MovedMember::placed(Vec3(0.0, 0.0, speed), Mat3::Zero());
  const auto drag_of = [&](bool goes_on) {
    std::vector<Segment> parts = member({0, 0, -15}, {0, 0, -5}, smooth(3.0), smooth(3.0), 2);
    for (Segment& part : parts) part.faces = {Face::wet, Face::wet};
    parts[0].goes_on[1] = parts[1].goes_on[0] = goes_on;
    const MorisonModel model{.buoyancy = false, .end_drag = {1.0, 1.0}};
    return MovedMember(parts, still_water(), model).move(from, to, velocity, 0.0, step).force[2];
  };
  const double face = 0.5 * 1025.0 * 0.25 * pi * 9.0 * speed * speed;
  EXPECT_NEAR(drag_of(true), -2.0 * face, 1e-9 * face);
  EXPECT_NEAR(drag_of(false), -4.0 * face, 1e-9 * face);
}

TEST(MorisonLoad, OfWavesUnderAFloatingCylinderIsThatOfThePressureOnItsFace) {
  for (const char* stretching : {"None", "Vertical", "Wheeler"}) {
    for (const double phase : {0.0, pi}) {
      const auto sea = waves(stretching, phase);
      MovedMember buoy(member({0, 0, -10}, {0, 0, 5}, smooth(2.0), smooth(2.0), 30), sea);
      const auto q = MovedMember::placed(Vec3::Zero(), Mat3::Identity());
      const double pressure = 1025.0 * 9.80665 * 10.0 + sea->motion({0, 0, -10}, 0.0).pressure;
      EXPECT_NEAR(buoy.stand(q).force[2] / (pressure * pi), 1.0, 1e-4) << stretching << phase;
    }
  }
}

// In a long wave pressure is the same everywhere: it lifts with the plane in which the surface cuts
// the body, whether that is counted as wet up to the crest or not.
TEST(MorisonLoad, OfLongWavesIsThatOfTheirHeightOnTheWaterplane) {
  const auto sea = waves("None", 0.0, 300.0);
  const double height = sea->elevation(Vec3::Zero(), 0.0);
  for (const double tilt : {0.0, 0.2, 0.5}) {
    const Mat3 directors = Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix();
    const auto q = MovedMember::placed(Vec3::Zero(), directors);
    const auto lifted = [&](const std::shared_ptr<const Sea>& water) {
      WetSection tube = smooth(2.0);
      tube.flooded_diameter = 1.0;
      return MovedMember(member({0, 0, -8}, {0, 0, 8}, tube, tube, 8), water).stand(q).force[2];
    };
    const double plane = pi * (1.0 - 0.25) / std::cos(tilt);
    EXPECT_NEAR((lifted(sea) - lifted(still_water(20.0))) / (1025.0 * 9.80665 * height * plane),
                1.0, 2e-3)
        << tilt;
  }
}

// A point that moves to and fro in still water loses 8/3 of its drag per cycle, and added mass
// takes nothing. @source fluids C17
TEST(MorisonLoad, OfACylinderThatMovesToAndFro) {
  const double X = 0.7, omega = 2.0, D = 1.5, length = 4.0;
  WetSection section;
  section.diameter = D;
  section.drag = 1.2;
  section.added_mass = 0.9;
  MovedMember pile(member({0, 0, -10}, {0, 0, -10 + length}, section, section, 2), still_water());
  const double expected = 8.0 / 3.0 * 0.5 * 1025.0 * 1.2 * D * X * X * X * omega * omega * length;
  double error[2];
  for (const int run : {0, 1}) {
    const int steps = run == 0 ? 200 : 400;
    const double h = 2.0 * pi / omega / steps;
    double work = 0.0;
    model::Coordinates velocity(12, 0.0);
    velocity[0] = X * omega;
    for (int i = 0; i < steps; ++i) {
      const auto at = [&](double t) {
        return MovedMember::placed({X * std::sin(omega * t), 0.0, 0.0}, Mat3::Identity());
      };
      const auto from = at(i * h), to = at((i + 1) * h);
      pile.move(from, to, velocity, i * h, h);
      velocity[0] = 2.0 / h * (to[0] - from[0]) - velocity[0];
      work += pile.work();
    }
    error[run] = std::abs(-work / expected - 1.0);
  }
  EXPECT_LT(error[0], 2e-3);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.2);
}

// Accelerated from rest: added mass, water inside and growth across the axis, growth along it.
TEST(MorisonLoad, WaterMovesAlong) {
  WetSection section{2.0, 1.0, 0.0, 0.8, 0.0, 0.1, 300.0};
  MovedMember tube(member({0, 0, -10}, {0, 0, -6}, section, section, 2), still_water(),
                   {.end_added_mass = {0.6, 0.4}});
  const auto q = MovedMember::placed(Vec3::Zero(), Mat3::Identity());
  const auto rest = tube.stand(q);
  const double h = 0.1;
  for (const int axis : {0, 2}) {
    auto to = q;
    to[static_cast<std::size_t>(axis)] = 1e-3;
    const auto found = tube.move(q, to, model::Coordinates(12, 0.0), 0.0, h);
    const double acceleration = 2.0 * 1e-3 / (h * h);
    const double water = 1025.0 * pi * 4.0;
    const double mass = axis == 0 ? water * (0.8 + 0.25) + 300.0 * 4.0
                                  : water * 0.1 + 300.0 * 4.0 + 2.0 * 0.5 * 1025.0 * 2.0 / 3.0 * pi;
    EXPECT_NEAR((found.force - rest.force)[axis], -mass * acceleration, 1e-9 * mass) << axis;
  }
}

// What stands more than once in a point adds up.
TEST(MorisonLoad, OnANodeThatIsNamedTwice) {
  std::vector<Segment> once = {segment({0, 0, -6}, {0, 0, -2}, 1.0, 1.0)}, twice = once;
  for (model::Marker& point : twice[0].ends) point = {{0, 0}, {1.4, -0.4}, point.offset};
  const auto q = MovedMember::placed({1.0, 0.0, 0.0}, Mat3::Identity());
  const auto expected = MovedMember(once, still_water()).stand(q);
  const auto found = MovedMember(twice, still_water()).stand(q);
  EXPECT_NEAR((found.force - expected.force).norm(), 0.0, 1e-9);
  EXPECT_NEAR((found.moment - expected.moment).norm(), 0.0, 1e-9);
}

TEST(MorisonLoad, WorkIsForceTimesMotion) {
  model::Model model;
  fill(model, false, 0.3);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil = Stencil::midpoint(state.time - state.time_prev);
  model::Batch* batch = kit::find_batch(model, effect);
  const Vec<24> r = dense.residual(state, stencil, {batch}).head<24>();
  const Eigen::Map<const Vec<24>> prev(state.prev.data());
  const Eigen::Map<const Vec<24>> next(state.next.data());
  EXPECT_NEAR(batch->step_work(state, stencil).external, -r.dot(next - prev), 1e-10);
}

TEST(MorisonLoad, ComesBackAsItWasAccepted) {
  model::Model model;
  fill(model, false, 0.3);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  model::State state = kit::random_state(model, 3);
  auto* load = dynamic_cast<MorisonLoad*>(kit::find_batch(model, effect));
  EXPECT_FALSE(load->resultant());
  dense.residual(state, Stencil::midpoint(0.4), {load});
  load->accept(state);
  const Vec3 force = load->resultant()->force;
  std::vector<double> memory(load->memory_size());
  load->save(model::Items::owned, memory);
  state = kit::random_state(model, 5);
  dense.residual(state, Stencil::midpoint(0.4), {load});
  EXPECT_EQ(load->resultant()->force, force);
  load->accept(state);
  EXPECT_NE(load->resultant()->force, force);
  load->restore(memory);
  EXPECT_EQ(load->resultant()->force, force);
}

TEST(MorisonLoad, SaysWhereItsMethodEnds) {
  WetSection section;
  for (const double diameter : {20.0, 30.0}) {
    section.diameter = diameter;
    model::Model model;
    model::NodeSlots slots;
    slots << Vec3::Zero(), Mat3::Identity();
    model.nodes().add(slots);
    const auto sea =
        make_sea("Regular Waves", {{"Depth", 20.0}, {"Height", 1.0}, {"Period", 10.0}});
    auto load = std::make_unique<MorisonLoad>(model::Effect("Morison", "tested"), model.nodes(),
                                              model::Amplitude::constant(), sea, MorisonModel{});
    load->add(member({0, 0, -20}, {0, 0, 5}, section, section, 1).front());
    auto* batch = load.get();
    model.add_load(std::move(load));
    model.freeze(model::Form::multipliers);
    const kit::DenseAssembly dense(model);
    EXPECT_NEAR(batch->range_used(), diameter / (0.2 * sea->main_length()), 1e-14);
    EXPECT_EQ(batch->range_used() > 1.0, diameter > 25.0);
    EXPECT_THAT(batch->range_warning(batch->range_used()), testing::HasSubstr("m thick"));
  }
}

// At the surface, and where waves do not reach.
TEST(MorisonLoad, SaysWhereSegmentsAreLongerThanWaves) {
  WetSection section;
  section.diameter = 0.1;
  for (const double depth : {1.0, 100.0}) {
    model::Model model;
    model::NodeSlots slots;
    slots << Vec3::Zero(), Mat3::Identity();
    model.nodes().add(slots);
    const auto sea =
        make_sea("Regular Waves", {{"Depth", 200.0}, {"Height", 0.2}, {"Period", 2.0}});
    auto load = std::make_unique<MorisonLoad>(model::Effect("Morison", "tested"), model.nodes(),
                                              model::Amplitude::constant(), sea, MorisonModel{});
    load->add(member({0, 0, -depth}, {3, 0, -depth}, section, section, 1).front());
    auto* batch = load.get();
    model.add_load(std::move(load));
    model.freeze(model::Form::multipliers);
    const kit::DenseAssembly dense(model);
    const double used = depth < 10.0 ? 9.0 / sea->main_length() : 0.5 / sea->main_length();
    EXPECT_NEAR(batch->range_used(), used, 1e-14);
    if (depth < 10.0) {
      EXPECT_THAT(batch->range_warning(used), testing::HasSubstr("segments of 3 m lie in waves"));
    }
  }
}

}  // namespace
}  // namespace culm::water
