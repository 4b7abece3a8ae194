#include <culm/base/error.hpp>
#include <culm/load/couple.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/port.hpp>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <utility>

namespace culm::port {
namespace {

using model::Coordinates;

// All coordinates by a formula of both ends of the step and the velocity at its start.
template <class Formula>
Coordinates combine(const model::State& state, Formula formula) {
  Coordinates result(state.next.size(), 0.0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double v = state.velocity.empty() ? 0.0 : state.velocity[i];
    result[i] = formula(state.next[i] - state.prev[i], v);
  }
  return result;
}

// Rates at the end of the step, 2 Dq / h - v; at the start where no step is open.
Coordinates end_velocity(const model::State& state) {
  const double h = state.velocity.empty() ? 0.0 : state.time - state.time_prev;
  return combine(state, [h](double moved, double v) { return h > 0.0 ? 2.0 / h * moved - v : v; });
}

// Dv / h = 2 (Dq / h - v) / h
Coordinates mean_acceleration(const model::State& state) {
  const double h = state.velocity.empty() ? 0.0 : state.time - state.time_prev;
  return combine(state,
                 [h](double moved, double v) { return h > 0.0 ? 2.0 / h * (moved / h - v) : 0.0; });
}

Coordinates mean(const model::State& state) {
  Coordinates result = state.next;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = 0.5 * (state.prev[i] + result[i]);
  return result;
}

void append(std::vector<double>& values, const Vec3& v) {
  values.insert(values.end(), v.begin(), v.end());
}

}  // namespace

Port::Port(std::string name, const model::NodeTable& nodes, std::vector<Place> places,
           PortLoad& load)
    : name_(std::move(name)),
      nodes_(nodes),
      places_(std::move(places)),
      load_(load),
      forces_(places_.size(), Vec3::Zero()),
      moments_(forces_) {
  for (const Place& place : places_) kinds_.push_back(kind_of(place.marker, nodes));
}

std::vector<double> Port::reference() const {
  std::vector<double> values;
  for (const Place& place : places_) append(values, position(place.marker, nodes_.reference()));
  return values;
}

std::vector<double> Port::read(Quantity quantity, const model::State& state) const {
  std::vector<double> values;
  values.reserve(places_.size() * static_cast<std::size_t>(components(quantity)));
  const auto each = [&](auto append_one) {
    for (std::size_t p = 0; p < places_.size(); ++p) append_one(places_[p].marker, kinds_[p]);
  };
  // rates of a point, and of its directors as the rotation that loads work on
  const auto append_rates = [&](const Coordinates& rates, const Coordinates& at) {
    each([&](const model::Marker& point, NodeKind kind) {
      append(values, position(point, rates));
      append(values, load::Couple(directors(point, at), kind).rotation(directors(point, rates)));
    });
  };
  switch (quantity) {
    case Quantity::position:
      each([&](const model::Marker& point, NodeKind) {
        append(values, position(point, state.next));
      });
      break;
    case Quantity::rotation:
      each([&](const model::Marker& point, NodeKind kind) {
        const Mat3 R = rotation(point, kind, nodes_.reference(), state.next);
        for (int i = 0; i < 3; ++i) append(values, R.row(i));
      });
      break;
    case Quantity::velocity:
      append_rates(end_velocity(state), state.next);
      break;
    case Quantity::acceleration:
      append_rates(mean_acceleration(state), mean(state));
      break;
    case Quantity::motion:
      each([&](const model::Marker& point, NodeKind kind) {
        append(values, displacement(point, state.prev, state.next));
        append(values, turn(point, kind, state.prev, state.next));
      });
      break;
  }
  return values;
}

std::vector<Vec3> Port::read_loads(const char* kind, std::span<const double> values) const {
  if (values.size() != 3 * places_.size()) {
    throw UsageError(fmt::format("port '{}' has {} points and takes {} values of {}, got {}", name_,
                                 places_.size(), 3 * places_.size(), kind, values.size()));
  }
  std::vector<Vec3> loads(places_.size());
  for (std::size_t p = 0; p < loads.size(); ++p) {
    loads[p] = Eigen::Map<const Vec3>(values.data() + 3 * p);
    if (loads[p].allFinite()) continue;
    throw NonFiniteError(fmt::format("port '{}' got ({}, {}, {}) for the {} at point {}", name_,
                                     loads[p][0], loads[p][1], loads[p][2], kind, p));
  }
  return loads;
}

void Port::set_loads(std::span<const double> forces, std::span<const double> moments) {
  std::vector<Vec3> f = read_loads("force", forces);
  std::vector<Vec3> m = moments.empty() ? std::vector<Vec3>(places_.size(), Vec3::Zero())
                                        : read_loads("moment", moments);
  forces_ = std::move(f);
  moments_ = std::move(m);
  load_.set(forces_, moments_);
}

void Port::take_loads(const Port& other) {
  forces_ = other.forces_;
  moments_ = other.moments_;
  load_.set(forces_, moments_);
}

Exchange Port::exchange(const model::State& state) const {
  Exchange sum;
  const Coordinates middle = mean(state);
  for (std::size_t p = 0; p < places_.size(); ++p) {
    const model::Marker& point = places_[p].marker;
    sum.work += forces_[p].dot(displacement(point, state.prev, state.next)) +
                moments_[p].dot(turn(point, kinds_[p], state.prev, state.next));
    sum.force += forces_[p];
    sum.moment += position(point, middle).cross(forces_[p]) + moments_[p];
    if (kinds_[p] == NodeKind::node12) continue;
    const Vec3 director = directors(point, middle).col(0);
    const Vec3 along = moments_[p].dot(director) / director.squaredNorm() * director;
    sum.moment -= along;
    sum.not_carried += along.norm();
  }
  return sum;
}

}  // namespace culm::port
