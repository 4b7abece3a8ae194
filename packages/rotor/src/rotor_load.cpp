#include <culm/rotor/induction.hpp>
#include <culm/rotor/rotor_load.hpp>
#include <culm/rotor/skewed_wake.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace culm::rotor {
namespace {

using std::numbers::pi;
// lags of the wake grow as the wind falls; slower wind than this counts as so fast [m/s]
constexpr double least_wind = 0.1;

Vec3 place_of(const model::Marker& point, const model::Coordinates& q) {
  Vec3 place = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    const auto slots = model::NodeTable::slots(q, point.nodes[a]);
    place += point.weights[a] * (slots.col(0) + slots.rightCols<3>() * point.offset);
  }
  return place;
}

Vec3 across(const Vec3& vector, const Vec3& unit) { return vector - vector.dot(unit) * unit; }

// Which part of the momentum balance counts: none where the tips are slower than the wind.
double turning_share(double tip_speed, double wind) {
  if (tip_speed <= wind) return 0.0;
  return std::min((tip_speed - wind) / std::max(wind, 1e-9), 1.0);
}

// A station as its balance sees it. The suction side lies downwind, or upwind in the mirror image.
// The loads have the angle of attack of the three-quarter chord, which turns about the quarter
// chord.
class Turned {
 public:
  // @param downwind  across the chord, downwind
  // @param share     of the forces that act, by the function of the strip
  Turned(const strip::Station& station, const strip::StationFlow& flow, const Vec3& downwind,
         double share)
      : station_(station),
        share_(share),
        mirror_(flow.across.dot(downwind) < 0.0 ? -1.0 : 1.0),
        speed_(flow.relative().norm()),
        along_(-flow.turning.dot(flow.along)),
        across_(-mirror_ * flow.turning.dot(flow.across)) {}

  const strip::Station& station() const { return station_; }
  // @param alpha  angle of attack of the quarter chord
  LiftDrag at(double alpha) const {
    const double sine = std::sin(alpha), cosine = std::cos(alpha);
    const double along = speed_ * cosine + along_, across = speed_ * sine + across_;
    strip::Coefficients slope;
    const strip::Coefficients c = station_.coefficients(mirror_ * std::atan2(across, along), slope);
    const double turn =
        speed_ * (along * cosine + across * sine) / (along * along + across * across);
    return {share_ * mirror_ * c[0], share_ * c[1], share_ * turn * slope[0],
            share_ * mirror_ * turn * slope[1]};
  }
  // What would have to be added to alpha for the same change of angle: by the speed, and by the
  // turning along and across the chord, downwind.
  Vec3 equal_to_alpha(double alpha) const {
    const double sine = std::sin(alpha), cosine = std::cos(alpha);
    const double along = speed_ * cosine + along_, across = speed_ * sine + across_;
    return Vec3(along * sine - across * cosine, across, -along) /
           (speed_ * (along * cosine + across * sine));
  }

 private:
  const strip::Station& station_;
  double share_;
  double mirror_;
  double speed_, along_, across_;  // [m/s]
};

}  // namespace

void RotorState::save(std::span<double> numbers) const {
  std::ranges::copy(centre, numbers.begin());
  std::ranges::copy(axis, numbers.begin() + 3);
  std::ranges::copy(wind, numbers.begin() + 6);
  numbers[9] = speed;
  numbers[10] = induction;
}

void RotorState::restore(std::span<const double> numbers) {
  centre = Vec3(numbers.data());
  axis = Vec3(numbers.data() + 3);
  wind = Vec3(numbers.data() + 6);
  speed = numbers[9];
  induction = numbers[10];
}

RotorLoad::RotorLoad(model::Effect effect, const model::NodeTable& nodes, RotorHub hub,
                     std::vector<strip::StripLoad*> blades, RotorModel kind)
    : MemorylessBatch(std::move(effect)),
      nodes_(nodes),
      hub_(std::move(hub)),
      blades_(std::move(blades)),
      kind_(kind) {
  for (strip::StripLoad* blade : blades_) {
    add_blade(*blade, nodes);
    blade->set_inducer(this);
  }
  accepted_.wake.resize(elements_.size());
  accepted_.angles.resize(elements_.size());
  trial_ = accepted_;
  flows_.resize(elements_.size());
  balances_.resize(elements_.size());
}

// Stations stand in the middle of their parts, so the blade goes on by half a part at both ends.
void RotorLoad::add_blade(strip::StripLoad& blade, const model::NodeTable& nodes) {
  const auto slots = model::NodeTable::slots(nodes.reference(), hub_.node);
  const Vec3 axis = slots.rightCols<3>() * hub_.axis;
  std::vector<double> radii;
  for (const strip::Station& station : blade.stations()) {
    radii.push_back(across(place_of(station.point, nodes.reference()) - slots.col(0), axis).norm());
  }
  const Vec3 outermost = place_of(blade.stations().back().point, nodes.reference()) - slots.col(0);
  lean_ += across(outermost, axis).normalized() / static_cast<double>(blades_.size());
  const std::size_t last = radii.size() - 1;
  const double root = 1.5 * radii[0] - 0.5 * radii[1];
  const double tip = 1.5 * radii[last] - 0.5 * radii[last - 1];
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double begin = i == 0 ? root : 0.5 * (radii[i - 1] + radii[i]);
    const double end = i == last ? tip : 0.5 * (radii[i] + radii[i + 1]);
    const double area = pi * (end * end - begin * begin) / static_cast<double>(blades_.size());
    elements_.push_back(
        {&blade, static_cast<int>(i), radii[i], area, std::max(root, 1e-3 * tip), tip});
  }
  tip_radius_ = std::max(tip_radius_, tip);
}

std::optional<RotorState> RotorLoad::state() const {
  if (!accepted_.has_stepped) return {};
  return accepted_.seen;
}

void RotorLoad::prepare(const model::State&, const Stencil&) {
  evaluated_.resize(0);
  trial_.angles = accepted_.angles;  // a step that is repeated finds the same
}

// The hub turns by the Cayley vector tau = 2 tan(angle / 2) axis: D d = tau x d_middle.
double RotorLoad::azimuth(const model::Coordinates& q) const {
  constexpr double whole = 2.0 * std::numbers::pi;
  constexpr double rounding = 1e-9;  // a whole turn is none
  const Mat3 start = model::NodeTable::slots(nodes_.reference(), hub_.node).rightCols<3>();
  const Mat3 now = model::NodeTable::slots(q, hub_.node).rightCols<3>();
  const Vec3 axis = (now * hub_.axis).normalized();
  const Vec3 mark = hub_.axis.unitOrthogonal();  // of the hub, across the axis
  const Vec3 from = Eigen::Quaterniond::FromTwoVectors(start * hub_.axis, axis) * (start * mark);
  const Vec3 to = now * mark;
  const double angle = std::atan2(axis.dot(from.cross(to)), from.dot(to));
  return angle < -rounding ? angle + whole : std::max(angle, 0.0);
}

RotorState RotorLoad::motion(const model::State& state, const Stencil& stencil) const {
  const model::NodeSlots prev = model::NodeTable::slots(state.prev, hub_.node);
  const model::NodeSlots next = model::NodeTable::slots(state.next, hub_.node);
  const model::NodeSlots middle = (1.0 - stencil.theta) * prev + stencil.theta * next;
  RotorState rotor;
  rotor.centre = middle.col(0);
  rotor.axis = (middle.rightCols<3>() * hub_.axis).normalized();
  if (const model::SteadyRotation* frame = blades_.front()->frame()) {
    rotor.speed = frame->speed(state, stencil) * frame->axis().dot(rotor.axis);
  }
  if (stencil.step == 0.0) return rotor;
  double turned = 0.0, arms = 0.0;
  for (int k = 1; k < 4; ++k) {
    const Vec3 arm = across(middle.col(k), rotor.axis);
    turned += arm.cross(Vec3(next.col(k) - prev.col(k))).dot(rotor.axis);
    arms += arm.squaredNorm();
  }
  rotor.speed += 2.0 * std::atan(0.5 * turned / arms) / stencil.step;
  return rotor;
}

double RotorLoad::share_of(const RotorState& rotor) const {
  return turning_share(std::abs(rotor.speed) * tip_radius_, std::abs(rotor.wind.dot(rotor.axis)));
}

// A rotation w of the section turns the span s by w x s, whose parts along normal n and `against`
// t are p and r. With the axis m n + k s:  dn = -k/m r t - p s,  dt = k/m r n - r s.
RotorLoad::Balanced RotorLoad::balance(const Element& element, const strip::StationFlow& flow,
                                       const RotorState& rotor, double near, double acting) const {
  const Vec3 span = flow.along.cross(flow.across);
  const Vec3 normal = across(rotor.axis, span);
  Balanced found;
  found.outwards = across(flow.place - rotor.centre, rotor.axis).normalized();
  found.normal = normal.normalized();
  const Vec3 motion = std::copysign(1.0, rotor.speed) * rotor.axis.cross(found.outwards);
  found.against = -across(across(motion, span), found.normal).normalized();
  const Eigen::RowVector3d of_normal = span.cross(found.normal),
                           of_against = span.cross(found.against);
  const Eigen::RowVector3d swing = rotor.axis.dot(span) / normal.norm() * of_against;
  found.normal_slope = -found.against * swing - span * of_normal;
  found.against_slope = found.normal * swing - span * of_against;

  const Vec3 relative = flow.relative();
  const double axial = relative.dot(found.normal);
  const double tangential = relative.dot(found.against);
  const double along = flow.along.dot(found.against), lead = flow.along.dot(found.normal);
  const Vec3 downwind = along * found.normal - lead * found.against;
  const Turned airfoil(element.strip->stations()[static_cast<std::size_t>(element.station)], flow,
                       downwind, acting);
  const Section section = [&airfoil](double alpha) { return airfoil.at(alpha); };
  const AnnulusPlace place{static_cast<int>(blades_.size()), element.radius, element.hub_radius,
                           element.tip_radius};
  const double twist = std::atan2(lead, along);
  const Induction induction = solve_induction(
      {place, kind_.losses, airfoil.station().chord, twist, axial, tangential, kind_.drag_induces},
      section, near);
  found.found = induction.found;
  if (!induction.found) return found;
  const double share = share_of(rotor);
  found.angle = induction.inflow_angle;
  found.induction = share * induction.axial;
  found.quasi_steady = {-share * induction.axial * axial,
                        share * induction.tangential * tangential};

  const Vec3 turn = airfoil.equal_to_alpha(induction.inflow_angle - twist);
  Mat<3, 9> slope = Mat<3, 9>::Zero();  // of axial and tangential wind, and of an angle of attack
  slope.block<1, 3>(0, 0) = -found.normal.transpose();
  slope.block<1, 3>(1, 0) = -found.against.transpose();
  slope.block<1, 3>(2, 0) = -turn[0] / std::max(relative.norm(), 1e-9) * relative.transpose();
  slope.block<1, 3>(2, 3) = turn[1] * flow.along.transpose() + turn[2] * downwind.transpose();
  slope.block<1, 3>(0, 6) = relative.transpose() * found.normal_slope;
  slope.block<1, 3>(1, 6) = relative.transpose() * found.against_slope;
  slope.block<1, 3>(2, 6) = turn[1] * flow.along.cross(flow.turning) +
                            turn[2] * downwind.cross(flow.turning) - flow.along.cross(downwind);
  slope.block<1, 3>(2, 6) += swing;
  const Mat<2, 9> of_induction = induction.slope * slope;
  found.axial_slope = -share * (axial * of_induction.row(0) + induction.axial * slope.row(0));
  found.tangential_slope =
      share * (tangential * of_induction.row(1) + induction.tangential * slope.row(1));
  return found;
}

InflowTimes RotorLoad::times_of(const Element& element, const RotorState& rotor) const {
  const double wind = std::max(std::abs(rotor.wind.dot(rotor.axis)), least_wind);
  return inflow_times(rotor.induction, wind, tip_radius_, element.radius / tip_radius_);
}

// Sets the wake at the end of the step; one that has not stepped yet is steady. A linearisation is
// about such a wake.
RotorLoad::Felt RotorLoad::follow(std::size_t element, const Induced& quasi_steady,
                                  const RotorState& rotor, const Stencil& stencil) {
  InflowState& end = trial_.wake[element];
  const bool moves = stencil.step > 0.0 && stencil.inertia > 0.0;
  const bool is_linearised = !moves && (stencil.step > 0.0 || stencil.frees_states);
  if (kind_.follow == Follow::steady || !accepted_.has_wake || !moves) {
    end = InflowState::steady(quasi_steady);
    Felt felt{end.induced, is_linearised && kind_.follow == Follow::frozen ? 0.0 : 1.0};
    if (is_linearised && kind_.follow == Follow::dynamic) {
      felt.times = times_of(elements_[element], accepted_.has_stepped ? accepted_.seen : rotor);
    }
    return felt;
  }
  const InflowState& wake = accepted_.wake[element];
  if (kind_.follow == Follow::frozen) {
    end = wake;
    return {wake.induced, 0.0};
  }
  const InflowTimes times = times_of(elements_[element], accepted_.seen);
  end = wake.after(stencil.step, times, quasi_steady, quasi_steady);
  return {0.5 * (wake.induced + end.induced), 0.5 * inflow_response(stencil.step, times)};
}

double RotorLoad::skew(const RotorState& rotor, const Element& element,
                       const Vec3& outwards) const {
  const Vec3 sideways = across(rotor.wind, rotor.axis);
  const double side = sideways.norm();
  if (!kind_.skewed_wake || side == 0.0) return 1.0;
  const double yaw = std::atan2(side, std::abs(rotor.wind.dot(rotor.axis)));
  const double azimuth = std::acos(std::clamp(outwards.dot(sideways) / side, -1.0, 1.0));
  return skew_factor(wake_skew(yaw, accepted_.seen.induction), element.radius / tip_radius_,
                     azimuth);
}

void RotorLoad::induce(const model::State& state, const Stencil& stencil) {
  if (std::ranges::equal(evaluated_, state.next) && evaluated_time_ == state.time &&
      evaluated_stencil_.step == stencil.step && evaluated_stencil_.inertia == stencil.inertia &&
      evaluated_stencil_.frees_states == stencil.frees_states) {
    return;
  }
  RotorState rotor = motion(state, stencil);
  double area = 0.0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Element& element = elements_[i];
    flows_[i] = element.strip->flow_at(element.station, state, stencil);
    rotor.wind += element.area * flows_[i].wind;
    area += element.area;
  }
  Vec3 hub_velocity = Vec3::Zero();
  if (stencil.step > 0.0) {
    const auto place = [&](const model::Coordinates& q) -> Vec3 {
      return model::NodeTable::slots(q, hub_.node).col(0);
    };
    hub_velocity = (place(state.next) - place(state.prev)) / stencil.step;
  }
  rotor.wind = rotor.wind / area - hub_velocity;  // a rotor that moves meets another wind
  const bool induces = kind_.follow != Follow::none;
  trial_.turns_otherwise =
      induces && (turns_otherwise(rotor, hub_velocity) || turns_across(rotor, state, stencil));
  trial_.unbalanced = 0;
  trial_.turning = induces ? share_of(rotor) : 0.0;
  for (std::size_t i = 0; i < elements_.size() && induces; ++i) {
    balances_[i] = balance(elements_[i], flows_[i], rotor, trial_.angles[i],
                           elements_[i].strip->amplitude().in_step(state, stencil));
    trial_.angles[i] = balances_[i].angle;
    rotor.induction += elements_[i].area / area * balances_[i].induction;
    trial_.unbalanced += balances_[i].found ? 0 : 1;
  }
  for (std::size_t i = 0; i < elements_.size() && induces; ++i) {
    const Element& element = elements_[i];
    const Balanced& found = balances_[i];
    const Felt felt = follow(i, found.quasi_steady, rotor, stencil);
    const double skewed = skew(rotor, element, found.outwards);
    const double axial = skewed * felt.induced[0], tangential = felt.induced[1];
    strip::InducedVelocity induced;
    induced.velocity = axial * found.normal + tangential * found.against;
    const Mat<3, 9> by_balance =
        skewed * found.normal * found.axial_slope + found.against * found.tangential_slope;
    if (felt.times) {
      induced.following = by_balance;
      induced.slow_time = felt.times->slow;
      induced.fast_time = felt.times->fast;
      induced.slow_share = slow_share(*felt.times);
    } else {
      induced.slope = felt.response * by_balance;
    }
    induced.slope.rightCols<3>() += axial * found.normal_slope + tangential * found.against_slope;
    const double through = flows_[i].relative().dot(found.normal);
    const double against = flows_[i].relative().dot(found.against);
    induced.inflow_angle = std::atan2(through + axial, against + tangential);
    induced.axial = through == 0.0 ? 0.0 : -axial / through;
    induced.tangential = against == 0.0 ? 0.0 : tangential / against;
    element.strip->set_induced(element.station, induced);
  }
  trial_.has_stepped = true;
  trial_.has_wake = accepted_.has_wake || (stencil.step > 0.0 && stencil.inertia > 0.0);
  trial_.seen = rotor;
  evaluated_ = state.next;
  evaluated_time_ = state.time;
  evaluated_stencil_ = stencil;
}

void RotorLoad::accept(model::State&) { accepted_ = trial_; }

// Of speeds that matter beside the wind, as those of a blade that stands and bends do not.
bool RotorLoad::turns_otherwise(const RotorState& rotor, const Vec3& hub_velocity) const {
  constexpr double most = 0.25;  // of the square, so that half of the speed is another one
  double all = 0.0, other = 0.0, wind = 0.0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Vec3 velocity = flows_[i].velocity - hub_velocity;
    const Vec3 turning = rotor.speed * rotor.axis.cross(flows_[i].place - rotor.centre);
    all += elements_[i].area * velocity.squaredNorm();
    other += elements_[i].area * (velocity - turning).squaredNorm();
    wind += elements_[i].area * flows_[i].wind.squaredNorm();
  }
  return all > wind && other > most * all;
}

// Where the rotor turns as fast as in operation; a machine that nods, yaws or floats turns the axis
// by much less than the rotor turns.
bool RotorLoad::turns_across(const RotorState& rotor, const model::State& state,
                             const Stencil& stencil) const {
  constexpr double most = 0.2;  // of what is about the axis
  if (share_of(rotor) < 1.0) return false;
  Vec3 turn = Vec3::Zero();
  if (const model::SteadyRotation* frame = blades_.front()->frame()) {
    turn = frame->speed(state, stencil) * frame->axis();
  }
  if (stencil.step > 0.0) {
    const model::NodeSlots prev = model::NodeTable::slots(state.prev, hub_.node);
    const model::NodeSlots next = model::NodeTable::slots(state.next, hub_.node);
    for (int k = 1; k < 4; ++k) {
      const Vec3 middle = 0.5 * (prev.col(k) + next.col(k)), way = next.col(k) - prev.col(k);
      turn += 0.5 / stencil.step * middle.cross(way);
    }
  }
  return across(turn, rotor.axis).norm() > most * std::abs(turn.dot(rotor.axis));
}

double RotorLoad::range_used() const {
  constexpr double even = 0.05;
  if (kind_.follow == Follow::none) return 0.0;
  if (accepted_.turns_otherwise) return Misuse::other_turn;
  if (accepted_.turning == 0.0) return 0.0;
  if (blades_.size() > 1 && lean_.norm() > even) return Misuse::uneven;
  if (accepted_.unbalanced > 0) return Misuse::unbalanced;
  const RotorState& rotor = accepted_.seen;
  const double along = std::abs(rotor.wind.dot(rotor.axis));
  if (!kind_.skewed_wake || along == 0.0) return 0.0;
  return std::atan2(across(rotor.wind, rotor.axis).norm(), along) / (0.25 * pi);
}

std::string RotorLoad::range_warning(double used) const {
  if (used == Misuse::uneven) {
    return effect().quoted() +
           ": its 'Blades' are not evenly spaced about the axis; each annulus counts those that "
           "are "
           "named, so name all of them";
  }
  if (used == Misuse::other_turn) {
    return effect().quoted() +
           ": the blades do not turn with the node of 'Hub' about 'Axis', by whose speed and "
           "direction induction is found";
  }
  if (used == Misuse::unbalanced) {
    return effect().quoted() +
           ": there were stations of the turning rotor at which blade element and momentum have no "
           "balance, as without wind along its axis; nothing is induced there";
  }
  return fmt::format(
      "{}: the wind met the axis at {:.3g} degrees; the correction for skewed wakes ends at 45, "
      "and "
      "blade element and momentum are made for less",
      effect().quoted(), 45.0 * used);
}

std::size_t RotorLoad::memory_size() const { return 2 + RotorState::size + 5 * elements_.size(); }

void RotorLoad::save(model::Items items, std::span<double> numbers) const {
  if (items == model::Items::owned && !blades_.front()->owns(0)) return;
  numbers[0] = accepted_.has_stepped ? 1.0 : 0.0;
  numbers[1] = accepted_.has_wake ? 1.0 : 0.0;
  accepted_.seen.save(numbers.subspan(2));
  auto rest = numbers.subspan(2 + RotorState::size).begin();
  for (const InflowState& wake : accepted_.wake) {
    rest = std::ranges::copy(wake.reduced, rest).out;
    rest = std::ranges::copy(wake.induced, rest).out;
  }
  std::ranges::copy(accepted_.angles, rest);
}

void RotorLoad::restore(std::span<const double> numbers) {
  accepted_.has_stepped = numbers[0] != 0.0;
  accepted_.has_wake = numbers[1] != 0.0;
  accepted_.seen.restore(numbers.subspan(2));
  const double* rest = numbers.data() + 2 + RotorState::size;
  for (InflowState& wake : accepted_.wake) {
    wake.reduced = Induced(rest);
    wake.induced = Induced(rest + 2);
    rest += 4;
  }
  std::copy_n(rest, accepted_.angles.size(), accepted_.angles.begin());
  trial_ = accepted_;
  evaluated_.resize(0);
}

}  // namespace culm::rotor
