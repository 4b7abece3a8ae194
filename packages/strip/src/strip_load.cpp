#include <culm/base/error.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/strip/strip_load.hpp>

#include "section_forces.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace culm::strip {
namespace {

using Motion = model::ItemMotion<StripLoad::max_nodes>;
using Columns = Mat<3, 3>;  // axis, chord, normal

// What the slots of node a do for the vectors of a section: columns axis, chord, normal.
Mat<4, 3> factors(const Station& station, std::size_t a) {
  const double weight = station.point.weights[a];
  Mat<4, 3> T;
  T.col(0) << weight, weight * station.point.offset;
  T.col(1) << 0.0, weight * station.along;
  T.col(2) << 0.0, weight * station.across;
  return T;
}

// The same for their coordinates, one after another.
Mat<12, 9> slots_of_vectors(const Mat<4, 3>& T) {
  Mat<12, 9> result = Mat<12, 9>::Zero();
  for (int s = 0; s < 4; ++s) {
    for (int p = 0; p < 3; ++p) {
      result.block<3, 3>(3 * s, 3 * p).diagonal().setConstant(T(s, p));
    }
  }
  return result;
}

// P^T T rows: what rows of the vectors of a section, one after another, are to the unknowns of a
// node. Where directors turn with it, their arms make those of the vectors, which are fewer.
template <class Space, class Rows, class Reduced>
void reduce_vectors(const Mat<4, 3>& T, const model::Arms<4>& arms, const Rows& rows,
                    Reduced& reduced) {
  if (Space::form == model::Form::null_space && arms.turns) {
    const model::Arms<3> of_vectors{arms.slots.lazyProduct(T), true};
    model::NullSpace::reduce_rows(rows, of_vectors, reduced.template topRows<6>());
    reduced.template topRows<3>() *= T(0, 0);  // the axis alone moves with the node
    return;
  }
  const Mat<12, Rows::ColsAtCompileTime> slots = slots_of_vectors(T).lazyProduct(rows);
  Space::reduce_rows(slots, arms, reduced);
}

template <class Slots>
Columns vectors_of(const Station& station, const Slots& slots) {
  Columns result = Columns::Zero();
  for (std::size_t a = 0; a < station.point.nodes.size(); ++a) {
    result += slots(station.point.nodes[a], a) * factors(station, a);
  }
  return result;
}

Columns vectors_of(const Station& station, const model::Coordinates& q) {
  return vectors_of(station, [&](int node, std::size_t) -> model::NodeSlots {
    return model::NodeTable::slots(q, node);
  });
}

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

struct StripLoad::Evaluation {
  Columns forces = Columns::Zero();          // on axis, chord and normal [N]
  Mat<9, 9> derivative = Mat<9, 9>::Zero();  // by those at the end of the step
  StationEnd end;
};

Coefficients Station::coefficients(double alpha, Coefficients& slope) const {
  const Coefficients one = airfoil->at(alpha, slope);
  if (blend == 0.0) return one;
  Coefficients next_slope;
  const Coefficients next = next_airfoil->at(alpha, next_slope);
  slope += blend * (next_slope - slope);
  return one + blend * (next - one);
}

std::array<double, StationState::size> StationState::numbers() const {
  const Vec3 &c = coefficients, &f = resultant.force, &m = resultant.moment;
  return {angle,    effective_angle,
          speed,    c[0],
          c[1],     c[2],
          normal,   tangential,
          attached, f[0],
          f[1],     f[2],
          m[0],     m[1],
          m[2],     inflow_angle,
          axial,    tangential_induction};
}

void StationState::set(std::span<const double> values) {
  angle = values[0];
  effective_angle = values[1];
  speed = values[2];
  coefficients = Vec3(values.data() + 3);
  normal = values[6];
  tangential = values[7];
  attached = values[8];
  resultant = {Vec3(values.data() + 9), Vec3(values.data() + 12)};
  inflow_angle = values[15];
  axial = values[16];
  tangential_induction = values[17];
}

void StripLoad::add(Station station) {
  stations_.push_back(std::move(station));
  owned_.push_back(false);
  induced_.emplace_back();
  accepted_.emplace_back();
  trial_.emplace_back();
  kept_.emplace_back();
}

std::vector<int> StripLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(stations_[static_cast<std::size_t>(item)].point.nodes, unknowns);
}

void StripLoad::place(model::Placement placement, model::Form form) {
  for (std::size_t i = 0; i < placement.items.size(); ++i) {
    owned_[static_cast<std::size_t>(placement.items[i])] = placement.owned[i];
  }
  MemorylessBatch::place(std::move(placement), form);
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
  found.wind = flow_->velocity(found.place, load::time_of(state, stencil));
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
  const double time = load::time_of(state, stencil);
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
  const double factor = station.length * (mass ? 1.0 : amplitude_.in_step(state, stencil));
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

// Where the frame turns from the first, this is told before anything is written.
void StripLoad::stand_in(const model::SteadyRotation& frame, Where where) {
  frame_ = &frame;
  frame_where_ = std::move(where);
  model::State start;
  start.prev = nodes_.reference();
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    refuse_wind_across_frame(i, start, Stencil::statics());
  }
}

void StripLoad::prepare(const model::State& state, const Stencil& stencil) {
  std::ranges::fill(kept_, Kept{});
  if (frame_ == nullptr) return;
  for (const int item : placement().items) {
    refuse_wind_across_frame(static_cast<std::size_t>(item), state, stencil);
  }
}

// Seen from the frame, the wind must be the same when the frame has turned on.
void StripLoad::refuse_wind_across_frame(std::size_t number, const model::State& state,
                                         const Stencil& stencil) const {
  constexpr int sides = 8;
  constexpr double same = 1e-6;
  if (frame_->speed(state, stencil) == 0.0) return;
  const Station& station = stations_[number];
  const Vec3 place = vectors_of(station, state.prev).col(0);
  const double time = load::time_of(state, stencil);
  const Vec3 wind = flow_->velocity(place, time);
  for (int side = 1; side < sides; ++side) {
    const Mat3 turn =
        Eigen::AngleAxisd(2.0 * std::numbers::pi * side / sides, frame_->axis()).matrix();
    const Vec3 there = turn.transpose() *
                       flow_->velocity(frame_->point() + turn * (place - frame_->point()), time);
    if ((there - wind).norm() <= same * std::max(wind.norm(), there.norm())) continue;
    throw InputError(
        frame_where_,
        fmt::format("{} stands in a rotating frame, but its wind is not the same from all sides: "
                    "at station {} it is {{{:.4g}, {:.4g}, {:.4g}}} m/s in the frame, and "
                    "{{{:.4g}, {:.4g}, {:.4g}}} after {} degrees.\nTake a wind along the axis that "
                    "does not depend on the azimuth, or a motion in time without the frame",
                    effect().quoted(), number, wind[0], wind[1], wind[2], there[0], there[1],
                    there[2], 360 / sides * side));
  }
}

Verdict StripLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                            model::Target& target) {
  if (want == Want::mass && !model_.apparent_mass) return Verdict::ok;
  if (inducer_ != nullptr && want != Want::mass) inducer_->induce(state, stencil);
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want, target);
  });
}

// r_s = -T_s F
template <class Space>
Verdict StripLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                 Want want, model::Target& target) {
  const auto number = static_cast<std::size_t>(placement().items[i]);
  const bool tangent = want != Want::residual;
  const Evaluation found = tangent ? evaluate<Dual>(number, state, stencil, want)
                                   : evaluate<double>(number, state, stencil, want);
  if (!std::isfinite(found.forces.sum())) return Verdict::not_finite;
  const bool mass = want == Want::mass;
  const double theta = mass ? 1.0 : stencil.theta;
  if (!mass) {
    trial_[number] = found.end;
    keep_forces(number, state, stencil, found.forces);
    const Station& station = stations_[number];
    const Motion motion(nodes_, station.point.nodes, state, theta);
    for (std::size_t a = 0; a < station.point.nodes.size(); ++a) {
      Vec<Space::width> residual;
      const Mat<4, 3> T = factors(station, a);
      const Vec<12> slots = Mat<3, 4>(-found.forces * T.transpose()).reshaped();
      Space::reduce_rows(slots, motion.arms_mid[a], residual);
      target.force_scale =
          std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
      placement().scatter.add_residual(i, static_cast<int>(a), residual.data(), target);
    }
  }
  if (tangent) add_tangent<Space>(i, found, state, theta, !mass, target);
  return Verdict::ok;
}

// dr / du = -(P_theta^T T) dF/dX (P_next^T T)^T,   X the vectors of the section at the end
template <class Space>
void StripLoad::add_tangent(std::size_t i, const Evaluation& found, const model::State& state,
                            double theta, bool turns, model::Target& target) {
  constexpr int W = Space::width;
  const Station& station = stations_[static_cast<std::size_t>(placement().items[i])];
  const std::size_t n = station.point.nodes.size();
  const Motion motion(nodes_, station.point.nodes, state, theta);
  std::array<Mat<4, 3>, max_nodes> T;
  for (std::size_t a = 0; a < n; ++a) T[a] = factors(station, a);
  const RowMat<9, 9> derivative = -found.derivative;
  for (std::size_t a = 0; a < n; ++a) {
    RowMat<W, 9> by_vectors;
    reduce_vectors<Space>(T[a], motion.arms_mid[a], derivative, by_vectors);
    const RowMat<9, W> transposed = by_vectors.transpose();
    for (std::size_t b = 0; b < n; ++b) {
      Mat<W, W> columns;
      reduce_vectors<Space>(T[b], motion.arms_next[b], transposed, columns);
      RowMat<W, W> block = columns.transpose();
      if (a == b && turns) {
        Space::add_turning(Mat<3, 4>(-found.forces * T[a].transpose()), motion.arms_next[a], theta,
                           block);
      }
      placement().scatter.add_tangent(i, static_cast<int>(a), static_cast<int>(b), block, target);
    }
  }
}

PerStateKind StripLoad::times_of(std::size_t number, const model::State& state) const {
  constexpr double distance = 1e-4;  // relative, below which times are moved apart
  const Station& station = stations_[number];
  PerStateKind times;
  times.fill(std::numeric_limits<double>::infinity());
  const double speed =
      evaluate<double>(number, state, Stencil::linearisation(), Want::residual).end.seen.speed;
  if (!(speed > 0.0)) return times;  // no wind, no load
  for (std::size_t k = 0; k < static_cast<std::size_t>(model_.lag.states); ++k) {
    times[state_kind::first_lag + k] = lag_time(model_.lag, k, 0.5 * station.chord, speed);
  }
  const bool stalls = station.airfoil->separation() != nullptr ||
                      (station.blend > 0.0 && station.next_airfoil->separation() != nullptr);
  if (model_.stall != Stall::none && stalls) {
    const bool four = model_.stall == Stall::four_states;
    if (four) times[state_kind::pressure] = pressure_time(station.chord, speed);
    times[state_kind::attached] = attached_time(model_.stall, station.chord, speed);
  }
  if (induced_[number].slow_time > 0.0) {
    times[state_kind::slow_inflow] = induced_[number].slow_time;
    times[state_kind::fast_inflow] = induced_[number].fast_time;
  }
  for (std::size_t k = 1; k < times.size(); ++k) {
    const auto others = std::span(times).first(k);
    while (std::isfinite(times[k]) && std::ranges::any_of(others, [&](double other) {
             return std::abs(other - times[k]) < distance * times[k];
           })) {
      times[k] *= 1.0 + 2.0 * distance;
    }
  }
  return times;
}

std::vector<double> StripLoad::delays(const model::State& state) const {
  std::vector<double> all;
  for (const int item : placement().items) {
    std::ranges::copy_if(times_of(static_cast<std::size_t>(item), state), std::back_inserter(all),
                         [](double time) { return std::isfinite(time); });
  }
  return all;
}

// The forces are affine in 1 / (1 + s T_k) of each kind k, so the factor of that of one of them is
// found where the others have the values T_k / (T_k - T_j) that they take at its pole.
Verdict StripLoad::assemble_delayed(const model::State& state, const Stencil& stencil, double delay,
                                    model::Target& target) {
  return assemble_items([&](auto space, std::size_t i) {
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const PerStateKind times = times_of(number, state);
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!(std::abs(times[k] - delay) <= model::same_delay * delay)) continue;
      PerStateKind follow = all_follow;
      for (std::size_t j = 0; j < times.size(); ++j) {
        if (j != k && std::isfinite(times[j])) follow[j] = times[k] / (times[k] - times[j]);
      }
      constexpr Want want = Want::residual_and_tangent;
      const Evaluation all = evaluate<Dual>(number, state, stencil, want, follow);
      follow[k] = 0.0;
      Evaluation gained = evaluate<Dual>(number, state, stencil, want, follow);
      gained.derivative -= all.derivative;
      if (!gained.derivative.allFinite()) return Verdict::not_finite;
      add_tangent<decltype(space)>(i, gained, state, stencil.theta, false, target);
    }
    return Verdict::ok;
  });
}

void StripLoad::keep_forces(std::size_t number, const model::State& state, const Stencil& stencil,
                            const Columns& forces) {
  kept_[number] = {vectors_of(stations_[number], state.next), state.time, stencil.step, forces};
}

const Columns* StripLoad::kept_forces(std::size_t number, const model::State& state,
                                      const Stencil& stencil) const {
  const Kept& kept = kept_[number];
  const bool is_same = kept.time == state.time && kept.step == stencil.step &&
                       kept.vectors == vectors_of(stations_[number], state.next);
  return is_same ? &kept.forces : nullptr;
}

void StripLoad::accept(model::State&) {
  accepted_ = trial_;
  has_stepped_ = true;
}

std::optional<flow::FluidForce::Resultant> StripLoad::resultant() const {
  if (!has_stepped_) return {};
  Resultant sum;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!owned_[i]) continue;
    sum.force += accepted_[i].seen.resultant.force;
    sum.moment += accepted_[i].seen.resultant.moment;
  }
  return sum;
}

double StripLoad::range_used() const {
  double used = 0.0;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!owned_[i]) continue;
    for (const SharedAirfoil* airfoil : {&stations_[i].airfoil, &stations_[i].next_airfoil}) {
      if (*airfoil == nullptr) continue;
      const std::optional<double> limit = (*airfoil)->good_to();
      if (limit) used = std::max(used, std::abs(accepted_[i].seen.effective_angle) / *limit);
    }
  }
  return used;
}

std::string StripLoad::range_warning(double used) const {
  return fmt::format(
      "{}: sections meet the wind at angles up to {:.2g} times the one to which their airfoils are "
      "good, 15 degrees of a 'Thin' one: it does not stall, and real ones do. Take a 'Polar'",
      effect().quoted(), used);
}

std::size_t StripLoad::memory_size() const {
  return 1 + stations_.size() * (SectionStates::size + StationState::size);
}

void StripLoad::save(model::Items items, std::span<double> numbers) const {
  const auto rest = numbers.subspan(1);
  if (items == model::Items::local || owned_[0]) numbers[0] = has_stepped_ ? 1.0 : 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (items == model::Items::owned && !placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const auto place = rest.subspan(number * (SectionStates::size + StationState::size));
    std::ranges::copy(accepted_[number].memory.numbers(), place.begin());
    std::ranges::copy(accepted_[number].seen.numbers(), place.subspan(SectionStates::size).begin());
  }
}

void StripLoad::restore(std::span<const double> numbers) {
  has_stepped_ = numbers[0] != 0.0;
  const auto rest = numbers.subspan(1);
  for (const int item : placement().items) {
    const auto number = static_cast<std::size_t>(item);
    const auto place = rest.subspan(number * (SectionStates::size + StationState::size));
    accepted_[number].memory.set(place.first(SectionStates::size));
    accepted_[number].seen.set(place.subspan(SectionStates::size, StationState::size));
  }
  trial_ = accepted_;
}

model::StepWork StripLoad::step_work(const model::State& state, const Stencil& stencil) const {
  if (inducer_ != nullptr) inducer_->induce(state, stencil);  // for this motion, and no other
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const Station& station = stations_[number];
    const Motion motion(nodes_, station.point.nodes, state, stencil.theta);
    const Columns* kept = kept_forces(number, state, stencil);
    const Columns forces =
        kept ? *kept : evaluate<double>(number, state, stencil, Want::residual).forces;
    Motion::Slots slots(3, motion.mid.cols());
    for (std::size_t a = 0; a < station.point.nodes.size(); ++a) {
      slots.middleCols<4>(4 * static_cast<int>(a)) = forces * factors(station, a).transpose();
    }
    load::add_item_work(slots, motion, station.point.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::strip
