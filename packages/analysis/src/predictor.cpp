#include <culm/analysis/path_condition.hpp>
#include <culm/analysis/predictor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace culm::analysis {
namespace {

constexpr std::size_t most_points = 4;
// A polynomial must be so much better than the plain guess to be trusted: vibrations that steps do
// not resolve make it better now and far worse in the next step.
constexpr double least_gain = 0.2;
// Share of the last step in what was seen lately.
constexpr double fading = 0.3;

std::string past_name(std::size_t k) { return "predictor/" + std::to_string(k); }

}  // namespace

// Lagrange's polynomial through the last mean velocities, at a time.
std::vector<double> Predictor::weights(int points, double time) const {
  std::vector<double> result(static_cast<std::size_t>(points), 1.0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t j = 0; j < result.size(); ++j) {
      if (i != j) result[i] *= (time - past_[j].time) / (past_[i].time - past_[j].time);
    }
  }
  return result;
}

void Predictor::predict(model::State& state, double step) const {
  Motions motions;
  if (points_ == 0) {
    motions = system_.velocities(state);
  } else {
    const std::vector<double> w = weights(points_, state.time_prev + 0.5 * step);
    motions.assign(past_.front().values.size(), Vec6::Zero());
    for (std::size_t node = 0; node < motions.size(); ++node) {
      for (std::size_t k = 0; k < w.size(); ++k) motions[node] += w[k] * past_[k].values[node];
    }
  }
  for (Vec6& motion : motions) motion *= step;
  system_.move_nodes(state, motions);
}

void Predictor::accept(const model::State& state, double step) {
  MeanVelocity now{state.time_prev + 0.5 * step, system_.motions(state)};
  for (Vec6& motion : now.values) motion /= step;
  const Motions start = system_.velocities(state);
  const double length = system_.model().length();
  std::array<double, most_points + 1> errors{};
  for (std::size_t points = 0; points <= past_.size(); ++points) {
    const std::vector<double> w = weights(static_cast<int>(points), now.time);
    Vec6 largest = Vec6::Zero();
    for (std::size_t node = 0; node < now.values.size(); ++node) {
      Vec6 error = -now.values[node];
      if (points == 0) error += start[node];
      for (std::size_t k = 0; k < points; ++k) error += w[k] * past_[k].values[node];
      largest = largest.cwiseMax(error.cwiseAbs());
    }
    errors[points] = std::max(largest.head<3>().maxCoeff() / length, largest.tail<3>().maxCoeff());
  }
  system_.comm().max(errors);
  const auto known = errors.begin() + static_cast<std::ptrdiff_t>(past_.size()) + 1;
  const auto best = std::min_element(errors.begin(), known);
  if (!past_.empty()) {
    reversal_ += fading * (measure_reversal(start, now) - reversal_);
  }
  if (past_.size() == most_points) past_.pop_back();
  past_.push_front(std::move(now));
  const bool is_better = *best < least_gain * errors[static_cast<std::size_t>(plain())];
  points_ = is_better ? static_cast<int>(best - errors.begin()) : plain();
}

// The velocity goes on as much from the middle of a step to its end as it did from its start.
// Rotations count by a tenth of the length of the model, as along paths.
double Predictor::measure_reversal(const Motions& start, const MeanVelocity& now) const {
  const double arm = PathCondition::turning_arm(system_.model());
  // before . before, after . after, before . after, of each unknown
  std::array<Vec6, 3> sums{Vec6::Zero(), Vec6::Zero(), Vec6::Zero()};
  for (std::size_t node = 0; node < system_.num_own_motions(); ++node) {
    const Vec6 before = start[node] - past_.front().values[node];
    const Vec6 after = now.values[node] - start[node];
    sums[0] += before.cwiseAbs2();
    sums[1] += after.cwiseAbs2();
    sums[2] += before.cwiseProduct(after);
  }
  std::array<double, 3> products;
  std::ranges::transform(sums, products.begin(), [arm](const Vec6& sum) {
    return sum.head<3>().sum() + arm * arm * sum.tail<3>().sum();
  });
  system_.comm().sum(products);
  const double squares = products[0] * products[1];
  return squares > 0.0 ? products[2] / std::sqrt(squares) : 1.0;
}

void Predictor::save(Snapshot& snapshot) const {
  snapshot.set("predictor/points", points_);
  snapshot.set("predictor/reversal", reversal_);
  std::vector<double> times;
  for (std::size_t k = 0; k < past_.size(); ++k) {
    times.push_back(past_[k].time);
    system_.save(past_[k].values, past_name(k), snapshot);
  }
  snapshot.set("predictor/times", std::move(times));
}

void Predictor::restore(const Snapshot& snapshot) {
  points_ = snapshot.integer("predictor/points");
  reversal_ = snapshot.number("predictor/reversal");
  past_.clear();
  for (const double time : snapshot.numbers("predictor/times")) {
    past_.push_back({time, system_.restore_motions(snapshot, past_name(past_.size()))});
  }
}

}  // namespace culm::analysis
