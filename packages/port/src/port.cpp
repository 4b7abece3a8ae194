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
  const auto append_rates = [&](const Vec3& rate, const Mat3& director_rates, const Mat3& at,
                                NodeKind kind) {
    append(values, rate);
    append(values, load::Couple(at, kind).rotation(director_rates));
  };
  const bool has_rates = !state.velocity.empty();
  const double h = has_rates ? state.time - state.time_prev : 0.0;
  switch (quantity) {
    case Quantity::position:
      each([&](const model::Marker& point, NodeKind) {
        append(values, position(point, state.next));
      });
      break;
    case Quantity::rotation:
      each([&](const model::Marker& point, NodeKind kind) {
        const Mat3 R =
            rotation(kind, directors(point, nodes_.reference()), directors(point, state.next));
        for (int i = 0; i < 3; ++i) append(values, R.row(i));
      });
      break;
    case Quantity::velocity:
      if (!has_rates) return zeros(quantity);
      // at the end of the open step 2 Dq / h - v, or now
      each([&](const model::Marker& point, NodeKind kind) {
        const Vec3 v = position(point, state.velocity);
        const Mat3 w = directors(point, state.velocity), at = directors(point, state.next);
        if (h <= 0.0) return append_rates(v, w, at, kind);
        const Change moved = change(point, state.prev, state.next);
        append_rates(2.0 / h * moved.x - v, 2.0 / h * moved.d - w, at, kind);
      });
      break;
    case Quantity::acceleration:
      if (h <= 0.0) return zeros(quantity);
      // Dv / h = 2 (Dq / h - v) / h
      each([&](const model::Marker& point, NodeKind kind) {
        const Change moved = change(point, state.prev, state.next);
        append_rates(2.0 / h * (moved.x / h - position(point, state.velocity)),
                     2.0 / h * (moved.d / h - directors(point, state.velocity)),
                     directors(point, state.prev) + 0.5 * moved.d, kind);
      });
      break;
    case Quantity::motion:
      each([&](const model::Marker& point, NodeKind kind) {
        const PointMotion moved = motion(point, kind, state.prev, state.next);
        append(values, moved.displacement);
        append(values, moved.turn);
      });
      break;
  }
  return values;
}

std::vector<double> Port::zeros(Quantity quantity) const {
  return std::vector<double>(places_.size() * static_cast<std::size_t>(components(quantity)), 0.0);
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
    const PointMotion moved = motion(point, kinds_[p], state.prev, state.next);
    sum.work += forces_[p].dot(moved.displacement) + moments_[p].dot(moved.turn);
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
