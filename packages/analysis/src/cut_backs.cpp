#include <culm/analysis/cut_backs.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace culm::analysis {
namespace {

using solver::StepEnd;

constexpr double notable_rejections = 0.05;  // of attempts that failed
// Cosine between changes of velocity in successive steps, below which steps do not resolve them:
// vibrations that go on by more than 70 degrees in a step.
constexpr double unresolved = 1.0 / 3.0;

std::size_t place(StepEnd end) { return static_cast<std::size_t>(end); }

// Who makes the steps may also refuse one that converged.
std::string reason(StepEnd end) {
  return end == StepEnd::converged ? "partners or the program that leads did not agree with them"
                                   : solver::describe(end);
}

}  // namespace

void CutBacks::accept(double taken, double turn) {
  accepted_ += 1.0;
  least_taken_ = std::min(least_taken_, taken);
  largest_turn_ = std::max(largest_turn_, turn);
}

void CutBacks::reject(StepEnd reason, double reversal) {
  rejected_ += 1.0;
  reversals_ += reversal;
  reasons_.at(place(reason)) += 1.0;
}

std::string CutBacks::hint(double step) const {
  const double attempts = accepted_ + rejected_;
  if (rejected_ <= notable_rejections * attempts) return {};
  const auto most = static_cast<std::size_t>(std::max_element(reasons_.begin(), reasons_.end()) -
                                             reasons_.begin());
  std::string text = fmt::format(
      "{:.0f} of {:.0f} attempts at a step failed and were cut back, {:.0f} because {}; steps down "
      "to "
      "{:.3g} s were needed where {:g} s are asked for.\n",
      rejected_, attempts, reasons_[most], reason(static_cast<StepEnd>(most)), least_taken_, step);
  const double cosine = reversals_ / rejected_;
  const double degrees = 180.0 / std::numbers::pi;
  if (static_cast<StepEnd>(most) == StepEnd::converged) {
    text += "Likely cause: loads that change much within a step.\n";
  } else if (static_cast<StepEnd>(most) == StepEnd::turned_too_far) {
    text += fmt::format(
        "Likely cause: nodes turn too far in a step; in those that were accepted by up to {:.0f} "
        "degrees.\n",
        degrees * largest_turn_);
  } else if (cosine < unresolved) {
    // of a vibration with frequency omega the step makes one that goes on by 2 atan(omega step / 2)
    const double product = 2.0 * std::sqrt((1.0 - cosine) / std::max(1e-6, 1.0 + cosine));
    text += fmt::format(
        "Likely cause: vibrations that the step does not resolve. Before these attempts changes of "
        "velocity\nturned round from step to step (cosine {:+.2f}), as with an angular frequency "
        "times step of {:.2g}.\n",
        cosine, product);
  } else {
    text += fmt::format(
        "Likely cause: steps that are long for this motion, in which nodes turn by up to {:.0f} "
        "degrees.\n",
        degrees * largest_turn_);
  }
  text += fmt::format("Try: 'Step' = {:.2g}", std::min(least_taken_, 0.5 * step));
  const bool is_fast = cosine < unresolved && static_cast<StepEnd>(most) != StepEnd::turned_too_far;
  return is_fast ? text + ", or 'Dissipation' and 'Velocity Dissipation' of the structures" : text;
}

void CutBacks::save(Snapshot& snapshot) const {
  std::vector<double> numbers = {accepted_, rejected_, least_taken_, largest_turn_, reversals_};
  numbers.insert(numbers.end(), reasons_.begin(), reasons_.end());
  snapshot.set("cut-backs", std::move(numbers));
}

void CutBacks::restore(const Snapshot& snapshot) {
  const std::span<const double> numbers = snapshot.numbers("cut-backs", 5 + num_reasons);
  accepted_ = numbers[0];
  rejected_ = numbers[1];
  least_taken_ = numbers[2];
  largest_turn_ = numbers[3];
  reversals_ = numbers[4];
  std::copy(numbers.begin() + 5, numbers.end(), reasons_.begin());
}

}  // namespace culm::analysis
