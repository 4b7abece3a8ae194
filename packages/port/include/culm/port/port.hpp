/// Points of structures at which another program sees motion and sets loads.
#pragma once

#include <culm/port/place.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/port_load.hpp>

#include <span>
#include <string>
#include <vector>

namespace culm::port {

/// What a port shows of each of its points, in space. A step is open from an attempt until it is
/// accepted or not; between steps its motion and its acceleration are zero.
enum class Quantity {
  position,      ///< at the end of the open step, or now [m]; 3 numbers
  rotation,      ///< against the reference, a 3x3 matrix row by row; 9 numbers
  velocity,      ///< and angular velocity at the same time [m/s, rad/s]; 6 numbers
  acceleration,  ///< and angular acceleration, mean of the open step [m/s^2, rad/s^2]; 6 numbers
  motion,        ///< in the open step and the rotation vector tau, what loads work on [m, rad]; 6
};

/// How many numbers a quantity has at each point.
constexpr int components(Quantity quantity) {
  return quantity == Quantity::position ? 3 : quantity == Quantity::rotation ? 9 : 6;
}

/// What went through a port in a step.
struct Exchange {
  double work = 0.0;           ///< sum of f . Dx + m . tau over the points [J]
  Vec3 force = Vec3::Zero();   ///< resultant [N]
  Vec3 moment = Vec3::Zero();  ///< about the origin, at the mean of both ends of the step [N m]
  /// Sum of the parts of moments along directors of shells, which nothing takes [N m].
  double not_carried = 0.0;
};

/// A named set of material points. Motion goes out by a constant linear map of the coordinates and
/// loads come in by its transpose, so that the work that the partner books, load times motion, is
/// the work that the structure gets. Velocities in an open step are those that follow from its
/// motion, 2 Dq / h - v; exact in the conserving scheme.
class Port {
 public:
  /// @param load  of the same points, in the model
  Port(std::string name, const model::NodeTable& nodes, std::vector<Place> places, PortLoad& load);

  const std::string& name() const { return name_; }
  int size() const { return static_cast<int>(places_.size()); }
  const std::vector<Place>& places() const { return places_; }

  /// Positions in the reference, 3 numbers per point [m].
  std::vector<double> reference() const;
  /// A quantity of all points, point after point. @param state  up to date at all nodes
  std::vector<double> read(Quantity quantity, const model::State& state) const;

  /// Loads of all attempts from now on, 3 numbers per point, in space: in dynamics means over the
  /// step. Throws UsageError for another number of values and NonFiniteError for no number; the
  /// loads stay as they were then.
  /// @param moments  about the points [N m]; none: zero
  void set_loads(std::span<const double> forces, std::span<const double> moments);
  /// Takes over those of another port with as many points.
  void take_loads(const Port& other);
  /// Whether any of them is not zero.
  bool is_loaded() const { return load_.is_loaded(); }
  /// One per point.
  const std::vector<Vec3>& forces() const { return forces_; }
  const std::vector<Vec3>& moments() const { return moments_; }
  /// What the present loads do in the step from state.prev to state.next.
  Exchange exchange(const model::State& state) const;

 private:
  std::vector<double> zeros(Quantity quantity) const;
  std::vector<Vec3> read_loads(const char* kind, std::span<const double> values) const;

  std::string name_;
  const model::NodeTable& nodes_;
  std::vector<Place> places_;
  std::vector<FlatPoint> points_;
  PortLoad& load_;
  std::vector<Vec3> forces_;
  std::vector<Vec3> moments_;
};

}  // namespace culm::port
