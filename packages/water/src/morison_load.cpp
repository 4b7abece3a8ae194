#include <culm/base/error.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/water/morison_load.hpp>

#include "member_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::water {
namespace {

using MorisonMotion = model::ItemMotion<MorisonLoad::max_nodes>;
using Ends = Mat<3, 2>;  // a column for each end of a segment

// Morison's formula is good for members up to this share of the length of waves.
// @source DNV-RP-C205, section 6.1.1
constexpr double slender = 0.2;
// The two points of a segment miss half a per cent of a wave that is three of its lengths long.
constexpr double resolved = 1.0 / 3.0;

// Numbers that carry the derivatives by the ends at the end of the step, times a factor.
void set(const Vec3& values, int, double, Vector<double>& result) { result = values; }
void set(const Vec3& values, int first, double factor, Vector<Dual>& result) {
  for (int i = 0; i < 3; ++i) result[i] = Dual(values[i], Vec6(factor * Vec6::Unit(first + i)));
}

template <class Number>
std::array<Vector<Number>, 2> carried(const Ends& values, double factor) {
  std::array<Vector<Number>, 2> result;
  set(values.col(0), 0, factor, result[0]);
  set(values.col(1), 3, factor, result[1]);
  return result;
}

void put(const Vector<double>& force, int end, Ends& values, Mat6&) { values.col(end) = force; }
void put(const Vector<Dual>& force, int end, Ends& values, Mat6& derivative) {
  for (int i = 0; i < 3; ++i) {
    values(i, end) = force[i].value();
    derivative.row(3 * end + i) = force[i].derivatives();
  }
}

}  // namespace

struct MorisonLoad::Evaluation {
  Ends forces = Ends::Zero();      // [N]
  Mat6 derivative = Mat6::Zero();  // by the places of the ends at the end of the step
  Resultant resultant;
  double swamped = 0.0;  // [m]
};

void MorisonLoad::add(Segment segment) {
  Item item;
  for (std::size_t end = 0; end < 2; ++end) {
    const model::Marker& point = segment.ends[end];
    for (std::size_t a = 0; a < point.nodes.size(); ++a) {
      const auto found = std::ranges::find(item.nodes, point.nodes[a]);
      const auto place = static_cast<std::size_t>(found - item.nodes.begin());
      if (found == item.nodes.end()) {
        item.nodes.push_back(point.nodes[a]);
        item.factors.emplace_back(Factors::Zero());
      }
      Vec<4> factors;
      factors << point.weights[a], point.weights[a] * point.offset;
      item.factors[place].col(static_cast<int>(end)) += factors;
    }
  }
  const Vec<2> heights = reference_ends(item).transpose() * sea_->site().up;
  // half a wave below still water there is little of it left
  const double top = heights.maxCoeff() - sea_->site().level;
  const double bottom = heights.minCoeff() - sea_->site().level;
  if (top > -0.5 * sea_->main_length() && bottom < sea_->highest()) {
    item.exposed = segment.length;
  }
  internal_check(item.nodes.size() <= max_nodes, "a segment has more nodes than MorisonLoad takes");
  item.segment = std::move(segment);
  items_.push_back(std::move(item));
}

std::vector<int> MorisonLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].nodes, unknowns);
}

void MorisonLoad::place(model::Placement placement, model::Form form) {
  for (std::size_t i = 0; i < placement.items.size(); ++i) {
    items_[static_cast<std::size_t>(placement.items[i])].owned = placement.owned[i];
  }
  MemorylessBatch::place(std::move(placement), form);
}

template <class Number>
MorisonLoad::Evaluation MorisonLoad::evaluate(const Item& item, const model::State& state,
                                              const Stencil& stencil, Want want) const {
  const auto ends_of = [&item](const model::Coordinates& q) {
    Ends result = Ends::Zero();
    for (std::size_t a = 0; a < item.nodes.size(); ++a) {
      result += model::NodeTable::slots(q, item.nodes[a]) * item.factors[a];
    }
    return result;
  };
  const bool mass = want == Want::mass;
  const bool moves = stencil.step > 0.0 && !mass;
  const double theta = mass ? 1.0 : stencil.theta;
  const Ends prev = ends_of(state.prev), next = ends_of(state.next);
  const double rate = moves ? 1.0 / stencil.step : 0.0;
  Ends acceleration = Ends::Zero();
  if (moves && stencil.inertia > 0.0) {
    acceleration = stencil.inertia * (next - prev) + ends_of(state.acceleration_offset);
  }
  const Ends middle = (1.0 - theta) * prev + theta * next;
  const SegmentMotion<Number> motion{carried<Number>(middle, mass ? 0.0 : theta),
                                     carried<Number>(rate * (next - prev), rate),
                                     carried<Number>(acceleration, mass ? 1.0 : stencil.inertia)};
  // without inertia it is an equilibrium, or a linearisation about one
  const double time = moves && stencil.inertia > 0.0 ? load::time_of(state, stencil) : 0.0;
  const SegmentForces<Number> found(item.segment, model_, *sea_, motion, time);
  Evaluation result;
  for (int end = 0; end < 2; ++end) {
    put(found.forces()[static_cast<std::size_t>(end)], end, result.forces, result.derivative);
  }
  for (int end = 0; end < 2; ++end) {
    const auto at = static_cast<std::size_t>(end);
    if (!item.segment.goes_on[at] || item.segment.has_next[at]) continue;
    const Vec3 place = middle.col(end);
    if (sea_->site().up.dot(place - middle.col(1 - end)) <= 0.0) continue;
    result.swamped = std::max(result.swamped, sea_->wet_to(place, time) - sea_->height(place));
  }
  const double factor = amplitude_.in_step(state, stencil);
  result.forces *= factor;
  result.derivative *= factor;
  result.resultant.force = result.forces.rowwise().sum();
  for (int end = 0; end < 2; ++end) {
    result.resultant.moment += Vec3(middle.col(end)).cross(Vec3(result.forces.col(end)));
  }
  return result;
}

Verdict MorisonLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                              model::Target& target) {
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want, target);
  });
}

// r_s = -T_s F      dr_s / dq_t = -T_s dF/dX T_t^T,   X the ends of the segment at the end
template <class Space>
Verdict MorisonLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                   Want want, model::Target& target) {
  Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const bool mass = want == Want::mass;
  const bool tangent = want != Want::residual;
  const Evaluation found = tangent ? evaluate<Dual>(item, state, stencil, want)
                                   : evaluate<double>(item, state, stencil, want);
  const double theta = mass ? 1.0 : stencil.theta;
  const MorisonMotion motion(nodes_, item.nodes, state, theta);
  MorisonMotion::Slots r(3, motion.mid.cols());
  for (std::size_t a = 0; a < item.nodes.size(); ++a) {
    r.middleCols<4>(4 * static_cast<int>(a)) = -found.forces * item.factors[a].transpose();
  }
  if (mass) {
    r.setZero();
  } else {
    item.trial = found.resultant;
    item.trial_swamped = found.swamped;
    const Verdict verdict =
        load::add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
    if (verdict != Verdict::ok) return verdict;
  }
  if (!tangent) return Verdict::ok;
  const auto by_slots = [&](int a, int b) {
    const Factors& T = item.factors[static_cast<std::size_t>(a)];
    const Factors& other = item.factors[static_cast<std::size_t>(b)];
    Mat<12, 12> K = Mat<12, 12>::Zero();
    for (int p = 0; p < 2; ++p) {
      for (int q = 0; q < 2; ++q) {
        const Mat3 part = -found.derivative.block<3, 3>(3 * p, 3 * q);
        for (int s = 0; s < 4; ++s) {
          for (int t = 0; t < 4; ++t) K.block<3, 3>(3 * s, 3 * t) += T(s, p) * other(t, q) * part;
        }
      }
    }
    return K;
  };
  load::add_dense_derivative<Space>(placement(), i, r, motion, theta, by_slots, target);
  return Verdict::ok;
}

void MorisonLoad::accept(model::State&) {
  for (Item& item : items_) {
    item.accepted = item.trial;
    item.swamped = item.trial_swamped;
  }
  has_stepped_ = true;
}

std::optional<flow::FluidForce::Resultant> MorisonLoad::resultant() const {
  if (!has_stepped_) return {};
  Resultant sum;
  for (const Item& item : items_) {
    if (!item.owned) continue;
    sum.force += item.accepted.force;
    sum.moment += item.accepted.moment;
  }
  return sum;
}

double MorisonLoad::range_used() const {
  const double length = sea_->main_length();
  double used = 0.0;
  for (const Item& item : items_) {
    if (!item.owned) continue;
    for (const WetSection& section : item.segment.sections) {
      used = std::max(used, section.diameter / (slender * length));
    }
    used = std::max(used, item.exposed / (resolved * length));
    if (item.swamped > 0.0) used = std::max(used, 1.0 + item.swamped);
  }
  return used;
}

std::string MorisonLoad::range_warning(double used) const {
  constexpr double rounding = 1e-9;
  const double length = sea_->main_length();
  double thickest = 0.0, longest = 0.0;
  for (const Item& item : items_) {
    for (const WetSection& section : item.segment.sections) {
      thickest = std::max(thickest, section.diameter);
    }
    longest = std::max(longest, item.exposed);
  }
  if (std::abs(longest - used * resolved * length) < rounding * longest) {
    return fmt::format(
        "{}: segments of {:.3g} m lie in waves {:.3g} m long, whose forces they do not resolve: "
        "take more 'Segments', of at most a third of the length each",
        effect().quoted(), longest, length);
  }
  if (std::abs(thickest - used * slender * length) < rounding * thickest) {
    return fmt::format(
        "{}: members up to {:.3g} m thick stand in waves {:.3g} m long: so thick ones scatter "
        "waves, which Morison's formula does not know; it is good up to a fifth of the length",
        effect().quoted(), thickest, length);
  }
  return fmt::format(
      "{}: the water stands {:.3g} m above the upper end of 'Range', beyond which the member goes "
      "on and nothing acts: let 'Range' reach higher",
      effect().quoted(), used - 1.0);
}

Ends MorisonLoad::reference_ends(const Item& item) const {
  Ends places = Ends::Zero();
  for (std::size_t a = 0; a < item.nodes.size(); ++a) {
    places += model::NodeTable::slots(nodes_.reference(), item.nodes[a]) * item.factors[a];
  }
  return places;
}

std::vector<MorisonLoad::DryFace> MorisonLoad::dry_faces() {
  std::vector<DryFace> found;
  for (Item& item : items_) {
    const Ends places = reference_ends(item);
    const Vec3 along = (places.col(1) - places.col(0)).normalized();
    for (std::size_t end = 0; end < 2; ++end) {
      if (item.segment.faces[end] != Face::dry) continue;
      found.push_back({&item.segment.faces[end], &item.segment.sections[end],
                       places.col(static_cast<int>(end)), end == 0 ? Vec3(-along) : along});
    }
  }
  return found;
}

void MorisonLoad::join(MorisonLoad& other) {
  constexpr double rounding = 1e-9;
  if (member_ == other.member_) {
    const auto touch = [](const MorisonLoad& before, const MorisonLoad& behind) {
      return std::abs(before.end_ - behind.begin_) < rounding;
    };
    if (touch(*this, other)) {
      items_.back().segment.has_next[1] = other.items_.front().segment.has_next[0] = true;
    }
    if (touch(other, *this)) {
      other.items_.back().segment.has_next[1] = items_.front().segment.has_next[0] = true;
    }
  }
  constexpr double same = 1e-6;
  constexpr double near = 0.01;  // a slice of a member may be between them
  const bool act_alike = sea_ == other.sea_ && model_.buoyancy == other.model_.buoyancy &&
                         amplitude_.is_constant() && other.amplitude_.is_constant() &&
                         amplitude_.at(0.0) == other.amplitude_.at(0.0);
  if (!act_alike) return;
  for (const DryFace& one : dry_faces()) {
    const double width = one.section->diameter;
    const auto is_as_wide = [&](double a, double b) { return std::abs(a - b) <= same * width; };
    for (const DryFace& facing : other.dry_faces()) {
      const bool meet = (one.place - facing.place).norm() <= near * width &&
                        (one.outward + facing.outward).norm() <= same &&
                        is_as_wide(facing.section->diameter, width) &&
                        is_as_wide(facing.section->flooded_diameter, one.section->flooded_diameter);
      if (!meet) continue;
      *one.face = *facing.face = Face::none;
      break;
    }
  }
}

bool MorisonLoad::meets(const MorisonLoad& other) const {
  constexpr double rounding = 1e-9;
  return member_ == other.member_ && begin_ < other.end_ - rounding &&
         other.begin_ < end_ - rounding;
}

bool MorisonLoad::acts_on(int node) const {
  return std::ranges::any_of(
      items_, [node](const Item& item) { return std::ranges::count(item.nodes, node) > 0; });
}

bool MorisonLoad::has_drag() const {
  return std::ranges::any_of(items_, [](const Item& item) {
    return std::ranges::any_of(item.segment.sections,
                               [](const WetSection& section) { return section.drag > 0.0; });
  });
}

void MorisonLoad::save(model::Items items, std::span<double> numbers) const {
  if (items == model::Items::local || items_.front().owned) numbers[0] = has_stepped_ ? 1.0 : 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (items == model::Items::owned && !placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const auto place = numbers.subspan(1 + 6 * number, 6);
    std::ranges::copy(items_[number].accepted.force, place.begin());
    std::ranges::copy(items_[number].accepted.moment, place.subspan(3).begin());
  }
}

void MorisonLoad::restore(std::span<const double> numbers) {
  has_stepped_ = numbers[0] != 0.0;
  for (const int item : placement().items) {
    const auto number = static_cast<std::size_t>(item);
    const double* place = numbers.data() + 1 + 6 * number;
    items_[number].accepted = {Vec3(place), Vec3(place + 3)};
    items_[number].trial = items_[number].accepted;
  }
}

model::StepWork MorisonLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const MorisonMotion motion(nodes_, item.nodes, state, stencil.theta);
    const Ends forces = evaluate<double>(item, state, stencil, Want::residual).forces;
    MorisonMotion::Slots slots(3, motion.mid.cols());
    for (std::size_t a = 0; a < item.nodes.size(); ++a) {
      slots.middleCols<4>(4 * static_cast<int>(a)) = forces * item.factors[a].transpose();
    }
    load::add_item_work(slots, motion, item.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::water
