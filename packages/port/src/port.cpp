#include <culm/base/error.hpp>
#include <culm/port/port.hpp>

#include <fmt/format.h>

#include <utility>

namespace culm::port {
namespace {

using model::NodeSlots;

void put(const Vec3& first, const Vec3& second, double* at) {
  Vec3::Map(at) = first;
  Vec3::Map(at + 3) = second;
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
  for (const Place& place : places_) points_.emplace_back(place.marker, nodes);
}

std::vector<double> Port::reference() const {
  std::vector<double> values(3 * points_.size());
  double* at = values.data();
  for (const FlatPoint& point : points_) {
    Vec3::Map(at) = point.place(point.slots(nodes_.reference()));
    at += 3;
  }
  return values;
}

std::vector<double> Port::read(Quantity quantity, const model::State& state) const {
  std::vector<double> values = zeros(quantity);
  const auto each = [&](auto read_one) {
    double* at = values.data();
    for (const FlatPoint& point : points_) {
      read_one(point, at);
      at += components(quantity);
    }
  };
  // of slots and of directors at the same time, as the rotation that loads work on
  const auto put_rates = [](const FlatPoint& point, const NodeSlots& rates, const NodeSlots& slots,
                            double* at) { put(point.place(rates), point.turn(slots, rates), at); };
  const bool has_rates = !state.velocity.empty();
  const double h = has_rates ? state.time - state.time_prev : 0.0;
  switch (quantity) {
    case Quantity::position:
      each([&](const FlatPoint& point, double* at) {
        Vec3::Map(at) = point.place(point.slots(state.next));
      });
      break;
    case Quantity::rotation:
      each([&](const FlatPoint& point, double* at) {
        Mat3::Map(at) = point.rotation(point.slots(state.next).rightCols<3>()).transpose();
      });
      break;
    case Quantity::velocity:
      if (!has_rates) break;
      // at the end of the open step 2 Dq / h - v, or now
      each([&](const FlatPoint& point, double* at) {
        NodeSlots rates = point.slots(state.velocity);
        if (h > 0.0) rates = 2.0 / h * point.change(state.prev, state.next) - rates;
        put_rates(point, rates, point.slots(state.next), at);
      });
      break;
    case Quantity::acceleration:
      if (h <= 0.0) break;
      // Dv / h = 2 (Dq / h - v) / h
      each([&](const FlatPoint& point, double* at) {
        const NodeSlots moved = point.change(state.prev, state.next);
        put_rates(point, 2.0 / h * (moved / h - point.slots(state.velocity)),
                  point.slots(state.prev) + 0.5 * moved, at);
      });
      break;
    case Quantity::motion:
      each([&](const FlatPoint& point, double* at) {
        const NodeSlots moved = point.change(state.prev, state.next);
        put_rates(point, moved, point.slots(state.prev) + 0.5 * moved, at);
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
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const FlatPoint& point = points_[p];
    const NodeSlots moved = point.change(state.prev, state.next);
    const NodeSlots middle = point.slots(state.prev) + 0.5 * moved;
    sum.work += forces_[p].dot(point.place(moved)) + moments_[p].dot(point.turn(middle, moved));
    sum.force += forces_[p];
    sum.moment += point.place(middle).cross(forces_[p]) + moments_[p];
    if (point.kind() == NodeKind::node12) continue;
    const Vec3 director = middle.col(1);
    const Vec3 along = moments_[p].dot(director) / director.squaredNorm() * director;
    sum.moment -= along;
    sum.not_carried += along.norm();
  }
  return sum;
}

}  // namespace culm::port
