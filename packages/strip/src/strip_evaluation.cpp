#include "strip_evaluation.hpp"

#include "section_forces.hpp"

#include <array>
#include <cstddef>

namespace culm::strip {
namespace {

// Numbers that carry the derivatives by the vectors at the end of the step, times a factor.
void set(const Vec3& values, int, double, Vector<double>& result) { result = values; }
void set(const Vec3& values, int first, double factor, Vector<Dual>& result) {
  for (int i = 0; i < 3; ++i) {
    result[i] = Dual(values[i], Vec<9>(factor * Vec<9>::Unit(first + i)));
  }
}

template <class Number>
SectionVectors<Number> carried(const Columns& values, double factor) {
  SectionVectors<Number> result;
  set(values.col(0), 0, factor, result.axis);
  set(values.col(1), 3, factor, result.chord);
  set(values.col(2), 6, factor, result.normal);
  return result;
}

// What the vectors of a section do for a point eta behind its axis, through a matrix.
Mat<3, 9> by_vectors_of_point(const Mat3& matrix, double eta) {
  Mat<3, 9> result;
  result << matrix, eta * matrix, Mat3::Zero();
  return result;
}

// What the vectors of a section at the end of the step do for its motion (`StationFlow`) against
// the wind, which has a gradient there, per metre: rows velocity, turning, rotation. With the triad
// c, g, s of along, across and span, a rotation w has w . s = g . dc, w . g = -s . dc, w . c = s .
// dg.
// @param by_place  derivative of the velocity of a point by its place at the end
Mat<9, 9> motion_of_vectors(const Station& station, const Columns& middle, double theta,
                            const Mat3& by_place, const Mat3& gradient) {
  const double chord = middle.col(1).norm();
  const Vec3 c = middle.col(1) / chord;
  const double leaning = middle.col(2).dot(c);
  const Vec3 upright = middle.col(2) - leaning * c;
  const double height = upright.norm();
  const Vec3 g = upright / height;
  const Vec3 s = c.cross(g);
  Mat<9, 9> result = Mat<9, 9>::Zero();
  result.topRows<3>() =
      by_vectors_of_point(by_place - theta * gradient, station.behind(station.force_at));
  result.block<3, 3>(3, 3) = (station.angle_at - station.force_at) * station.chord * by_place;
  result.block<3, 3>(6, 3) =
      theta / chord * (s * g.transpose() - Vec3(g + leaning / height * c) * s.transpose());
  result.block<3, 3>(6, 6) = theta / height * c * s.transpose();
  return result;
}

// Adds a velocity with the derivatives that rows of a matrix hold.
template <class Derivative>
void add_velocity(const Vec3& velocity, const Derivative&, Vector<double>& result) {
  result += velocity;
}
template <class Derivative>
void add_velocity(const Vec3& velocity, const Derivative& derivative, Vector<Dual>& result) {
  const Mat<3, 9> by_vectors = derivative();
  for (int i = 0; i < 3; ++i) {
    result[i].value() += velocity[i];
    result[i].derivatives() += by_vectors.row(i).transpose();
  }
}

// Adds vectors of a section that a matrix makes of those at the end of the step.
template <class Number>
void add_vectors(const Columns& values, const Mat3& matrix, SectionVectors<Number>& result) {
  const auto by_vector = [&](int k) {
    return [&matrix, k]() -> Mat<3, 9> {
      Mat<3, 9> by_vectors = Mat<3, 9>::Zero();
      by_vectors.block<3, 3>(0, 3 * k) = matrix;
      return by_vectors;
    };
  };
  add_velocity(values.col(0), by_vector(0), result.axis);
  add_velocity(values.col(1), by_vector(1), result.chord);
  add_velocity(values.col(2), by_vector(2), result.normal);
}

// A frame that turns with a section in a step: the matrix of its angular velocity, and a point of
// its axis.
struct Turning {
  Mat3 turn = Mat3::Zero();
  Vec3 point = Vec3::Zero();

  Turning(const model::SteadyRotation* frame, const model::State& state, const Stencil& stencil) {
    if (frame == nullptr) return;
    turn = frame->speed(state, stencil) * skew(frame->axis());
    point = frame->point();
  }
  // Velocity of the frame where the vectors of a section are.
  Columns velocity(Columns place) const {
    place.col(0) -= point;
    return turn * place;
  }
};

void put(const Vector<double>& force, int column, Columns& values, Mat<9, 9>&) {
  values.col(column) = force;
}
void put(const Vector<Dual>& force, int column, Columns& values, Mat<9, 9>& derivative) {
  for (int i = 0; i < 3; ++i) {
    values(i, column) = force[i].value();
    derivative.row(3 * column + i) = force[i].derivatives();
  }
}

}  // namespace

double StripLoad::time_of_flow(const model::State& state, const Stencil& stencil) const {
  const double time = load::time_of(state, stencil);
  return stencil.step > 0.0 && stencil.inertia > 0.0 ? time : flow_->time_at_level(time);
}

StationFlow StripLoad::flow_at(int number, const model::State& state,
                               const Stencil& stencil) const {
  const Station& station = stations_[static_cast<std::size_t>(number)];
  const Columns prev = vectors_of(station, state.prev);
  const Columns next = vectors_of(station, state.next);
  const Columns middle = (1.0 - stencil.theta) * prev + stencil.theta * next;
  const double eta = station.behind(station.force_at);
  const double lever = (station.angle_at - station.force_at) * station.chord;
  StationFlow found;
  found.place = middle.col(0) + eta * middle.col(1);
  found.along = middle.col(1).normalized();
  found.across = (middle.col(2) - middle.col(2).dot(found.along) * found.along).normalized();
  if (stencil.step > 0.0) {
    const Columns moved = next - prev;
    found.velocity = (moved.col(0) + eta * moved.col(1)) / stencil.step;
    found.turning = lever / stencil.step * moved.col(1);
  }
  if (frame_ != nullptr) {
    const Columns velocity = Turning(frame_, state, stencil).velocity(middle);
    found.velocity += velocity.col(0) + eta * velocity.col(1);
    found.turning += lever * velocity.col(1);
  }
  found.wind = flow_->velocity(found.place, time_of_flow(state, stencil));
  return found;
}

template <class Number>
StripLoad::Evaluation StripLoad::evaluate(std::size_t station_number, const model::State& state,
                                          const Stencil& stencil, Want want,
                                          const PerStateKind& follow) const {
  const Station& station = stations_[station_number];
  const bool mass = want == Want::mass;
  const bool moves = stencil.step > 0.0 && !mass;
  const double theta = mass ? 1.0 : stencil.theta;
  const Columns prev = vectors_of(station, state.prev);
  const Columns next = vectors_of(station, state.next);
  const Columns moved = next - prev;
  const double rate = moves ? 1.0 / stencil.step : 0.0;
  Columns acceleration = Columns::Zero();
  if (moves && stencil.inertia > 0.0) {
    acceleration = stencil.inertia * moved + vectors_of(station, state.acceleration_offset);
  }
  SectionMotion<Number> motion;
  motion.place = carried<Number>((1.0 - theta) * prev + theta * next, mass ? 0.0 : theta);
  motion.velocity = carried<Number>(rate * moved, rate);
  motion.acceleration = carried<Number>(acceleration, mass ? 1.0 : stencil.inertia);
  const Columns middle = (1.0 - theta) * prev + theta * next;
  Mat3 by_place = rate * Mat3::Identity();
  if (frame_ != nullptr && !mass) {  // omega x x, and omega x (omega x x) + 2 omega x v
    const Turning frame(frame_, state, stencil);
    const Columns velocity = frame.velocity(middle);
    add_vectors(velocity, theta * frame.turn, motion.velocity);
    add_vectors(frame.turn * (velocity + 2.0 * rate * moved),
                frame.turn * (theta * frame.turn + 2.0 * by_place), motion.acceleration);
    by_place += theta * frame.turn;
  }

  Surroundings<Number> around;
  around.density = flow_->density();
  // where there is no inertia, a linearisation asks: lags have ended
  around.step = moves && stencil.inertia > 0.0 ? stencil.step : 0.0;
  around.memory = accepted_[station_number].memory;
  around.follow = follow;
  const std::array<double, 2> behind = {station.behind(station.force_at),
                                        station.behind(station.angle_at)};
  const std::array<Vec3, 2> places = {middle.col(0) + behind[0] * middle.col(1),
                                      middle.col(0) + behind[1] * middle.col(1)};
  const double time = time_of_flow(state, stencil);
  std::array<Vec3, 2> winds;
  flow_->velocities(places, time, winds);
  std::array<Mat3, 2> gradients = {Mat3::Zero(), Mat3::Zero()};
  if (want == Want::residual_and_tangent) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      gradients[k] = flow_->gradient(places[k], time);
    }
  }
  for (const std::size_t k : {0U, 1U}) {
    Vector<Number>& wind = k == 0 ? around.wind_at_force : around.wind_at_angle;
    wind.setConstant(Number(0.0));
    const auto by_vectors = [&] { return by_vectors_of_point(theta * gradients[k], behind[k]); };
    add_velocity(winds[k], by_vectors, wind);
  }
  // to the section it is as if it moved against what is induced
  const InducedVelocity& induced = induced_[station_number];
  const double followed = induced.slow_share * follow[state_kind::slow_inflow] +
                          (1.0 - induced.slow_share) * follow[state_kind::fast_inflow];
  const auto by_vectors = [&]() -> Mat<3, 9> {
    const Mat<3, 9> slope = induced.slope + followed * induced.following;
    return -slope.lazyProduct(motion_of_vectors(station, middle, theta, by_place, gradients[0]));
  };
  if (!mass) add_velocity(-induced.velocity, by_vectors, motion.velocity.axis);

  const SectionLoads<Number> loads = section_loads<Number>(station, model_, motion, around);
  Evaluation result;
  put(loads.forces.axis, 0, result.forces, result.derivative);
  put(loads.forces.chord, 1, result.forces, result.derivative);
  put(loads.forces.normal, 2, result.forces, result.derivative);
  const Vec3 span = Vec3(middle.col(1)).cross(Vec3(middle.col(2))).normalized();
  const double within = flow_->share_within(places[0], 0.5 * station.length * span, time);
  const double factor = within * station.length * amplitude_.in_step(state, stencil);
  result.forces *= factor;
  result.derivative *= factor;
  result.end = {loads.memory, loads.seen};
  result.end.seen.inflow_angle = induced.inflow_angle;
  result.end.seen.axial = induced.axial;
  result.end.seen.tangential_induction = induced.tangential;
  result.end.seen.resultant.force = result.forces.col(0);
  for (int k = 0; k < 3; ++k) {
    result.end.seen.resultant.moment += Vec3(middle.col(k)).cross(Vec3(result.forces.col(k)));
  }
  return result;
}

template StripLoad::Evaluation StripLoad::evaluate<double>(std::size_t, const model::State&,
                                                           const Stencil&, Want,
                                                           const PerStateKind&) const;
template StripLoad::Evaluation StripLoad::evaluate<Dual>(std::size_t, const model::State&,
                                                         const Stencil&, Want,
                                                         const PerStateKind&) const;

}  // namespace culm::strip
