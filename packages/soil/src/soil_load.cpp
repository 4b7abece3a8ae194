#include <culm/load/slot_kernel.hpp>
#include <culm/soil/soil_load.hpp>

#include <algorithm>
#include <array>

namespace culm::soil {
namespace {

constexpr std::size_t max_sliders = SoilLoad::max_sliders;

using Motion = model::ItemMotion<SoilLoad::max_nodes>;

// T_s of the slots of node a.
Vec<4> factors(const model::Marker& point, std::size_t a) {
  Vec<4> T;
  T << point.weights[a], point.weights[a] * point.offset;
  return T;
}

Motion::Slots slot_forces(const model::Marker& point, const Vec3& force) {
  Motion::Slots forces(3, 4 * static_cast<int>(point.nodes.size()));
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    forces.middleCols<4>(4 * static_cast<int>(a)) = force * factors(point, a).transpose();
  }
  return forces;
}

Vec3 place_of(const model::Marker& point, const model::Coordinates& q) {
  Vec3 place = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    place += model::NodeTable::slots(q, point.nodes[a]) * factors(point, a);
  }
  return place;
}

struct Resistance {
  Vec3 force = Vec3::Zero();  // against the displacement
  Mat3 derivative = Mat3::Zero();
};

// Of the distance |y| at the end of a step.
Resistance at_end(const Curve& curve, const Vec3& y) {
  const double r = y.norm();
  const double slope = curve.slope(r);
  if (r == 0.0) return {Vec3::Zero(), slope * Mat3::Identity()};
  const Vec3 e = y / r;
  const double over = curve.force(r) / r;
  return {over * y, over * Mat3::Identity() + (slope - over) * e * e.transpose()};
}

// m G with the mean m of the force and G . Dy = D|y|, G = (y_prev + y_next) / (|y_prev| + |y_next|)
Resistance over_step(const Curve& curve, const Vec3& prev, const Vec3& next) {
  const double before = prev.norm();
  const double after = next.norm();
  const double sum = before + after;
  if (sum == 0.0) return {Vec3::Zero(), 0.5 * curve.slope(0.0) * Mat3::Identity()};
  const Curve::Mean mean = curve.mean(before, after);
  const Vec3 G = (prev + next) / sum;
  const Vec3 e = after > 0.0 ? Vec3(next / after) : Vec3(Vec3::Zero());
  return {mean.value * G, mean.value / sum * Mat3::Identity() +
                              (mean.derivative - mean.value / sum) * G * e.transpose()};
}

}  // namespace

void SoilLoad::add(Station station) {
  reference_.push_back(place_of(station.point, nodes_.reference()));
  first_slip_.push_back(slips_.size());
  slips_.resize(slips_.size() + station.lateral_sliders.size() + station.axial_sliders.size(),
                Vec3::Zero());
  CULM_ASSERT(station.lateral_sliders.size() <= max_sliders &&
              station.axial_sliders.size() <= max_sliders);
  stations_.push_back(std::move(station));
}

const Station* SoilLoad::meets(const SoilLoad& other) const {
  if (pile_ != other.pile_) return nullptr;
  const auto is_tip = [](const Station& station) { return station.begin == station.end; };
  const auto both_hold = [&](const Station& one, const Station& two) {
    const double rounding = 1e-9 * std::max(one.end, two.end);
    const bool share_length = one.begin < two.end - rounding && two.begin < one.end - rounding;
    if (!share_length && !(is_tip(one) && is_tip(two))) return false;
    return (one.holds_across() && two.holds_across()) || (one.holds_along() && two.holds_along());
  };
  for (const Station& one : stations_) {
    for (const Station& two : other.stations_) {
      if (both_hold(one, two)) return &one;
    }
  }
  return nullptr;
}

std::vector<int> SoilLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(stations_[static_cast<std::size_t>(item)].point.nodes, unknowns);
}

Vec3 SoilLoad::displacement(std::size_t station, const model::Coordinates& q) const {
  return place_of(stations_[station].point, q) - reference_[station];
}

std::span<const Vec3> SoilLoad::slips_of(std::size_t number) const {
  const Station& station = stations_[number];
  return std::span(slips_).subspan(first_slip_[number],
                                   station.lateral_sliders.size() + station.axial_sliders.size());
}

SoilLoad::Answer SoilLoad::slide_station(std::size_t number, const Vec3& prev, const Vec3& next,
                                         double theta, std::span<Vec3> slips) const {
  const Station& station = stations_[number];
  const Mat3 along = station.along * station.along.transpose();
  const std::size_t lateral = station.lateral_sliders.size();
  Answer answer;
  const auto add = [&](std::span<const Slider> sliders, const Mat3& P, std::span<Vec3> own) {
    const SliderResponse response = slide(sliders, P * prev, P * next, theta, own);
    answer.force -= station.length * response.force;
    answer.derivative += station.length * P * response.derivative * P;
    answer.slid += station.length * response.slid;
  };
  add(station.lateral_sliders, Mat3::Identity() - along, slips.first(lateral));
  add(station.axial_sliders, along, slips.subspan(lateral));
  return answer;
}

// The mean of the step at theta = 1/2, its end at 1.
SoilLoad::Answer SoilLoad::respond(std::size_t number, const Vec3& prev, const Vec3& next,
                                   double theta) const {
  const Station& station = stations_[number];
  const Vec3& n = station.along;
  const Mat3 across = Mat3::Identity() - n * n.transpose();
  const double of_end = 2.0 * theta - 1.0;
  Answer answer;
  const std::span<const Vec3> accepted = slips_of(number);
  if (!accepted.empty()) {
    std::array<Vec3, 2 * max_sliders> trial;
    std::ranges::copy(accepted, trial.begin());
    answer = slide_station(number, prev, next, theta, std::span(trial).first(accepted.size()));
  }
  const auto add = [&](const Resistance& resistance, const Mat3& P, double share) {
    answer.force -= share * station.length * (P * resistance.force);
    answer.derivative += share * station.length * (P * resistance.derivative * P);
  };
  if (station.lateral) {
    add(at_end(*station.lateral, across * next), across, of_end);
    if (theta != 1.0) {
      add(over_step(*station.lateral, across * prev, across * next), across, 1.0 - of_end);
    }
  }
  if (station.axial) {
    const Mat3 P = n * n.transpose();
    const double before = n.dot(prev);
    const double after = n.dot(next);
    add({station.axial->force(after) * n, station.axial->slope(after) * P}, P, of_end);
    if (theta != 1.0) {
      const Curve::Mean mean = station.axial->mean(before, after);
      add({mean.value * n, mean.derivative * P}, P, 1.0 - of_end);
    }
  }
  return answer;
}

SoilLoad::Answer SoilLoad::respond(std::size_t number, const model::State& state,
                                   double theta) const {
  return respond(number, displacement(number, state.prev), displacement(number, state.next), theta);
}

Verdict SoilLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                           model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want == Want::residual_and_tangent,
                                          target);
  });
}

// r_s = -T_s F      dr_s / dq_t = -T_s T_t dF/dx
template <class Space>
Verdict SoilLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                bool tangent, model::Target& target) const {
  const auto number = static_cast<std::size_t>(placement().items[i]);
  const model::Marker& point = stations_[number].point;
  const Motion motion(nodes_, point.nodes, state, stencil.theta);
  const Answer answer = respond(number, state, stencil.theta);
  const Motion::Slots r = -slot_forces(point, answer.force);
  const Verdict verdict =
      load::add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  const auto by_slots = [&](int a, int b) {
    const Vec<4> T = factors(point, static_cast<std::size_t>(a));
    const Vec<4> other = factors(point, static_cast<std::size_t>(b));
    Mat<12, 12> K;
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) K.block<3, 3>(3 * s, 3 * t) = T[s] * other[t] * answer.derivative;
    }
    return K;
  };
  load::add_dense_derivative<Space>(placement(), i, r, motion, stencil.theta, by_slots, target);
  return Verdict::ok;
}

void SoilLoad::accept(model::State& state) {
  if (slips_.empty()) return;
  for (const int item : placement().items) {
    const auto number = static_cast<std::size_t>(item);
    slide_station(number, displacement(number, state.prev), displacement(number, state.next), 1.0,
                  std::span(slips_).subspan(first_slip_[number], slips_of(number).size()));
  }
}

void SoilLoad::save(model::Items items, std::span<double> numbers) const {
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (items == model::Items::owned && !placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    double* to = numbers.data() + 3 * first_slip_[number];
    for (const Vec3& slip : slips_of(number)) to = std::ranges::copy(slip, to).out;
  }
}

void SoilLoad::restore(std::span<const double> numbers) {
  for (std::size_t i = 0; i < slips_.size(); ++i) slips_[i] = Vec3(numbers.data() + 3 * i);
}

double SoilLoad::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const Station& station = stations_[number];
    const Vec3 u = displacement(number, q);
    const double along = station.along.dot(u);
    if (station.lateral) {
      energy += station.length * station.lateral->energy((u - along * station.along).norm());
    }
    if (station.axial) energy += station.length * station.axial->energy(along);
    const std::span<const Vec3> slips = slips_of(number);
    const std::size_t lateral = station.lateral_sliders.size();
    energy += station.length *
              (energy_of(station.lateral_sliders, u - along * station.along, slips.first(lateral)) +
               energy_of(station.axial_sliders, along * station.along, slips.subspan(lateral)));
  }
  return energy;
}

model::StepWork SoilLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const model::Marker& point = stations_[number].point;
    const Motion motion(nodes_, point.nodes, state, stencil.theta);
    const Answer answer = respond(number, state, stencil.theta);
    load::add_item_work(slot_forces(point, answer.force), motion, point.nodes, state, false, work);
    work.damping += answer.slid;
  }
  return work;
}

SoilLoad::Sample SoilLoad::sample(int item, const model::Coordinates& q) const {
  const auto number = static_cast<std::size_t>(item);
  const Vec3 u = displacement(number, q);
  return {u, respond(number, u, u, 1.0).force};
}

}  // namespace culm::soil
