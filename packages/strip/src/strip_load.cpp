#include <culm/strip/strip_load.hpp>

#include "section_forces.hpp"
#include "strip_tangent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::strip {

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

void StripLoad::prepare(const model::State& state, const Stencil& stencil) {
  std::ranges::fill(kept_, Kept{});
  if (frame_ == nullptr) return;
  for (const int item : placement().items) {
    refuse_wind_across_frame(static_cast<std::size_t>(item), state, stencil);
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
    const StationNodes motion(nodes_, station.point.nodes, state, theta);
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
    const StationNodes motion(nodes_, station.point.nodes, state, stencil.theta);
    const Columns* kept = kept_forces(number, state, stencil);
    const Columns forces =
        kept ? *kept : evaluate<double>(number, state, stencil, Want::residual).forces;
    StationNodes::Slots slots(3, motion.mid.cols());
    for (std::size_t a = 0; a < station.point.nodes.size(); ++a) {
      slots.middleCols<4>(4 * static_cast<int>(a)) = forces * factors(station, a).transpose();
    }
    load::add_item_work(slots, motion, station.point.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::strip
