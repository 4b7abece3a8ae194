#include <culm/load/slot_kernel.hpp>
#include <culm/water/potential_load.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::water {
namespace {

using PotentialMotion = model::ItemMotion<1>;
using Complex = std::complex<double>;

constexpr double small_turn = 0.1;  // [rad]; sines and their linear parts differ by 0.2 %

}  // namespace

PotentialLoad::PotentialLoad(model::Effect effect, const model::NodeTable& nodes,
                             model::Amplitude amplitude, std::shared_ptr<const Sea> sea, int node,
                             FloatingBody body)
    : MemorylessBatch(std::move(effect)),
      FluidForce(*sea),
      nodes_(nodes),
      amplitude_(std::move(amplitude)),
      sea_(std::move(sea)),
      motion_(nodes, node),
      body_(std::move(body)),
      accepted_(body_.radiation.terms.size(), Eigen::Matrix<Complex, 6, 1>::Zero()),
      trial_(accepted_) {
  const Vec3 place = model::NodeTable::slots(nodes.reference(), node).col(0);
  for (const Wave& wave : sea_->waves()) {
    const double heading = std::atan2(wave.direction.y(), wave.direction.x());
    const auto forces = excitation_of(body_.flow, wave.frequency,
                                      heading_in(body_.flow, heading).value_or(heading));
    // the wave at the node: cos(omega t - lag)
    const double lag = wave.phase + wave.number * wave.direction.dot(place);
    WaveForce one;
    one.frequency = wave.frequency;
    for (int i = 0; i < 6; ++i) {
      one.force[i] = wave.amplitude * std::polar(1.0, -lag) * forces[i];
    }
    waves_.push_back(one);
  }
}

std::vector<int> PotentialLoad::blocks(int, const model::UnknownTable& unknowns) const {
  return blocks_of(motion_.nodes(), unknowns);
}

Vec6 PotentialLoad::waves(double time) const {
  Vec6 sum = Vec6::Zero();
  for (const WaveForce& wave : waves_) {
    const Complex turn = std::polar(1.0, wave.frequency * time);
    for (int i = 0; i < 6; ++i) sum[i] += std::real(wave.force[i] * turn);
  }
  return sea_->growth(time) * sum;
}

// z_1 (1 - h p / 2) = z_0 (1 + h p / 2) + Dx, the force is that of the mean of both
PotentialLoad::Evaluation PotentialLoad::evaluate(const model::State& state, const Stencil& stencil,
                                                  Want want, States& trial) const {
  Evaluation result;
  if (want == Want::mass) {
    result.derivative = -amplitude_.in_step(state, stencil) * body_.flow.infinite_mass;
    return result;
  }
  const bool moves = stencil.step > 0.0 && stencil.inertia > 0.0;
  const Vec6 prev = motion_.motion(state.prev), next = motion_.motion(state.next);
  const double theta = stencil.theta;
  result.force = body_.rest - body_.flow.hydrostatics * ((1.0 - theta) * prev + theta * next) +
                 waves(moves ? load::time_of(state, stencil) : 0.0);
  result.derivative = -theta * body_.flow.hydrostatics;
  if (moves) {
    const Vec6 acceleration =
        stencil.inertia * (next - prev) + motion_.rates(state.acceleration_offset);
    result.force -= body_.flow.infinite_mass * acceleration;
    result.derivative -= stencil.inertia * body_.flow.infinite_mass;
    const double h = stencil.step;
    result.force -= body_.radiation.extra * (next - prev) / h;
    result.derivative -= body_.radiation.extra / h;
    for (std::size_t k = 0; k < trial.size(); ++k) {
      const auto& [pole, residue] = body_.radiation.terms[k];
      const Complex denominator = 1.0 - 0.5 * h * pole;
      trial[k] = (accepted_[k] * (1.0 + 0.5 * h * pole) + (next - prev)) / denominator;
      result.force -= (residue * (accepted_[k] + trial[k])).real();
      result.derivative -= (residue / denominator).real();
    }
  } else if (!stencil.frees_states) {
    // at rest for so long that the waves it has made are gone
    for (auto& one : trial) one.setZero();
  }
  const double factor = amplitude_.in_step(state, stencil);
  result.force *= factor;
  result.derivative *= factor;
  return result;
}

Verdict PotentialLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                                model::Target& target) {
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want, target);
  });
}

template <class Space>
Verdict PotentialLoad::assemble_item(std::size_t i, const model::State& state,
                                     const Stencil& stencil, Want want, model::Target& target) {
  const bool mass = want == Want::mass;
  const double theta = mass ? 1.0 : stencil.theta;
  const Evaluation found = evaluate(state, stencil, want, trial_);
  const PotentialMotion motion(nodes_, motion_.nodes(), state, theta);
  PotentialMotion::Slots r = -motion_.slot_forces(found.force);
  if (mass) {
    r.setZero();
  } else {
    trial_force_.force = found.force.head<3>();
    trial_force_.moment =
        Vec3(found.force.tail<3>()) + Vec3(motion.mid.col(0)).cross(trial_force_.force);
    const Verdict verdict =
        load::add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
    if (verdict != Verdict::ok) return verdict;
  }
  if (want == Want::residual) return Verdict::ok;
  const Mat<12, 12> K = -motion_.slot_derivative(found.derivative);
  load::add_dense_derivative<Space>(
      placement(), i, r, motion, theta, [&K](int, int) { return K; }, target);
  return Verdict::ok;
}

void PotentialLoad::accept(model::State& state) {
  accepted_ = trial_;
  accepted_force_ = trial_force_;
  largest_turn_ = std::max(largest_turn_, motion_.motion(state.next).tail<3>().norm());
  has_stepped_ = true;
}

std::optional<flow::FluidForce::Resultant> PotentialLoad::resultant() const {
  if (!has_stepped_) return {};
  if (placement().items.empty() || !placement().owned[0]) return Resultant{};
  return accepted_force_;
}

double PotentialLoad::range_used() const {
  return placement().items.empty() ? 0.0 : largest_turn_ / small_turn;
}

std::string PotentialLoad::range_warning(double used) const {
  return fmt::format(
      "{}: the body turns by {:.3g} rad, but linear potential flow is that of small "
      "motions; it is good up to {:g} rad",
      effect().quoted(), used * small_turn, small_turn);
}

std::string PotentialLoad::left_out_of_modes() const {
  if (body_.radiation.terms.empty()) return {};
  return effect().quoted() +
         ": modes have the added mass at infinite frequency, and no waves that the body makes";
}

void PotentialLoad::save(model::Items items, std::span<double> numbers) const {
  if (placement().items.empty()) return;
  if (items == model::Items::owned && !placement().owned[0]) return;
  numbers[0] = has_stepped_ ? 1.0 : 0.0;
  numbers[1] = largest_turn_;
  std::ranges::copy(accepted_force_.force, numbers.begin() + 2);
  std::ranges::copy(accepted_force_.moment, numbers.begin() + 5);
  for (std::size_t k = 0; k < accepted_.size(); ++k) {
    for (std::size_t i = 0; i < 6; ++i) {
      numbers[8 + 12 * k + 2 * i] = accepted_[k][static_cast<int>(i)].real();
      numbers[9 + 12 * k + 2 * i] = accepted_[k][static_cast<int>(i)].imag();
    }
  }
}

void PotentialLoad::restore(std::span<const double> numbers) {
  has_stepped_ = numbers[0] != 0.0;
  largest_turn_ = numbers[1];
  accepted_force_ = {Vec3(numbers.data() + 2), Vec3(numbers.data() + 5)};
  trial_force_ = accepted_force_;
  for (std::size_t k = 0; k < accepted_.size(); ++k) {
    for (std::size_t i = 0; i < 6; ++i) {
      accepted_[k][static_cast<int>(i)] = {numbers[8 + 12 * k + 2 * i],
                                           numbers[9 + 12 * k + 2 * i]};
    }
  }
  trial_ = accepted_;
}

model::StepWork PotentialLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  if (placement().items.empty() || !placement().owned[0]) return work;
  States trial = accepted_;
  const Vec6 force = evaluate(state, stencil, Want::residual, trial).force;
  const PotentialMotion motion(nodes_, motion_.nodes(), state, stencil.theta);
  load::add_item_work(motion_.slot_forces(force), motion, motion_.nodes(), state, true, work);
  return work;
}

}  // namespace culm::water
