/// Members on one node in a sea, for tests.
#pragma once

#include <culm/water/morison_load.hpp>

#include "sea_kit.hpp"

#include <Eigen/Geometry>
#include <culm_kit/batch_laws.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace culm::water::test {

inline const std::string effect = "Morison, tested";

inline std::shared_ptr<const Sea> still_water(double depth = 200.0) {
  return make_sea("Still Water", {{"Depth", depth}, {"Gravity", 9.80665}});
}

/// Between places on node 0, in its directors.
inline Segment segment(const Vec3& from, const Vec3& to, double first_diameter,
                       double last_diameter) {
  Segment segment;
  segment.ends = {model::marker_at(0), model::marker_at(0)};
  segment.ends[0].offset = from;
  segment.ends[1].offset = to;
  segment.length = (to - from).norm();
  segment.sections[0].diameter = first_diameter;
  segment.sections[1].diameter = last_diameter;
  return segment;
}

/// A straight member in equal segments, whose radius is linear.
inline std::vector<Segment> member(const Vec3& from, const Vec3& to, const WetSection& first,
                                   const WetSection& last, int count) {
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    Segment one;
    one.length = (to - from).norm() / count;
    for (int end = 0; end < 2; ++end) {
      const double s = static_cast<double>(i + end) / count;
      const auto e = static_cast<std::size_t>(end);
      one.ends[e] = model::marker_at(0);
      one.ends[e].offset = (1.0 - s) * from + s * to;
      one.sections[e] = first;
      one.sections[e].diameter = (1.0 - s) * first.diameter + s * last.diameter;
    }
    segments.push_back(one);
  }
  segments.front().faces[0] = Face::wet;
  segments.back().faces[1] = Face::wet;
  return segments;
}

/// A node that carries segments and is moved as one likes, by the conserving scheme.
class MovedMember {
 public:
  MovedMember(const std::vector<Segment>& segments, std::shared_ptr<const Sea> sea,
              const MorisonModel& kind = {}) {
    model::NodeSlots slots;
    slots << Vec3::Zero(), Mat3::Identity();
    model_.nodes().add(slots);
    auto load = std::make_unique<MorisonLoad>(model::Effect("Morison", "tested"), model_.nodes(),
                                              model::Amplitude::constant(), std::move(sea), kind);
    for (const Segment& one : segments) load->add(one);
    load_ = load.get();
    model_.add_load(std::move(load));
    model_.freeze(model::Form::multipliers);
    dense_ = std::make_unique<kit::DenseAssembly>(model_);
    state_ = model_.initial_state();
    state_.velocity.assign(state_.prev.size(), 0.0);
    state_.acceleration_offset.assign(state_.prev.size(), 0.0);
  }

  static model::Coordinates placed(const Vec3& place, const Mat3& directors) {
    model::NodeSlots slots;
    slots << place, directors;
    return {slots.data(), slots.data() + slots.size()};
  }
  /// At rest, at a place.
  flow::FluidForce::Resultant stand(const model::Coordinates& q) {
    state_.prev = state_.next = q;
    dense_->residual(state_, Stencil::statics(), {load_});
    load_->accept(state_);
    return *load_->resultant();
  }
  /// Derivative of minus the forces by the place, at rest there [N/m].
  Mat3 stiffness(const model::Coordinates& q) {
    state_.prev = state_.next = q;
    return dense_->tangent(state_, Stencil::statics(), {load_}).topLeftCorner<3, 3>();
  }
  /// A step between two places, by the plain acceleration of it.
  flow::FluidForce::Resultant move(const model::Coordinates& from, const model::Coordinates& to,
                                   const model::Coordinates& velocity, double time, double step) {
    const Stencil stencil = Stencil::midpoint(step);
    state_.prev = from;
    state_.next = to;
    state_.velocity = velocity;
    state_.time_prev = time;
    state_.time = time + step;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      state_.acceleration_offset[i] = -2.0 / step * velocity[i];
    }
    dense_->residual(state_, stencil, {load_});
    work_ = load_->step_work(state_, stencil).external;
    load_->accept(state_);
    return *load_->resultant();
  }
  /// Of the last move [J].
  double work() const { return work_; }

 private:
  model::Model model_;
  MorisonLoad* load_ = nullptr;
  std::unique_ptr<kit::DenseAssembly> dense_;
  model::State state_;
  double work_ = 0.0;
};

}  // namespace culm::water::test
