#include <culm/analysis/path_condition.hpp>
#include <culm/analysis/predictor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>

namespace culm::analysis {
namespace {

// A polynomial must be so much better than the plain guess to be trusted: vibrations that steps do
// not resolve make it better now and far worse in the next step.
constexpr double least_gain = 0.2;
// Share of the last step in what was seen lately.
constexpr double fading = 0.3;

std::string past_name(std::size_t k) { return "predictor/" + std::to_string(k); }

// Joins numbers of nodes for each of the six unknowns.
template <class Join>
Vec6 by_unknown(const NodeRow& row, Join join) {
  Vec6 joined;
  for (int node = 0; node < 4; ++node) {
    for (int c = 0; c < 6; ++c) {
      const int i = 6 * node + c;
      const double number = row.of(i % pack_lanes, i / pack_lanes);
      joined[c] = node == 0 ? number : join(joined[c], number);
    }
  }
  return joined;
}

}  // namespace

// Lagrange's polynomial through the last mean velocities, at a time.
GuessWeights Predictor::weights(int points, double time) const {
  GuessWeights result{};
  for (std::size_t i = 0; i < index(points); ++i) {
    result[i] = 1.0;
    for (std::size_t j = 0; j < index(points); ++j) {
      if (i != j) result[i] *= (time - past_[j].time) / (past_[i].time - past_[j].time);
    }
  }
  return result;
}

void Predictor::predict(model::State& state, double step) const {
  const GuessWeights w = weights(points_, state.time_prev + 0.5 * step);
  system_.move_nodes(state, [&](std::size_t first, std::span<Vec6> motions) {
    if (points_ == 0) {
      system_.velocities(state, first, motions);
    } else {
      std::ranges::fill(motions, Vec6::Zero());
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
      for (std::size_t k = 0; k < index(points_); ++k)
        motions[i] += w[k] * past_[k].values[first + i];
      motions[i] *= step;
    }
  });
}

void Predictor::accept(const model::State& state, double step) {
  MeanVelocity now{state.time_prev + 0.5 * step, Motions(system_.num_motions())};
  std::array<GuessWeights, max_past> w{};
  for (std::size_t k = 0; k < past_.size(); ++k) w[k] = weights(static_cast<int>(k) + 1, now.time);
  GuessErrors errors{};
  VelocityChanges changes{};
  std::array<Vec6, 128> start;
  const std::size_t num_own = system_.num_own_motions();
  for (std::size_t first = 0; first < now.values.size(); first += start.size()) {
    const std::size_t count = std::min(start.size(), now.values.size() - first);
    const std::span<Vec6> mean = std::span(now.values).subspan(first, count);
    system_.motions(state, first, mean);
    for (Vec6& motion : mean) motion /= step;
    system_.velocities(state, first, std::span(start).first(count));
    VelocityRows rows{start.front().data(), mean.front().data(), {}, past_.size()};
    for (std::size_t k = 0; k < past_.size(); ++k) rows.past[k] = past_[k].values[first].data();
    compare_guesses(rows, count, w, errors);
    if (past_.empty() || first >= num_own) continue;
    add_changes(rows, std::min(count, num_own - first), changes);
  }
  std::array<double, max_past + 1> largest{};
  for (std::size_t p = 0; p <= past_.size(); ++p) {
    const Vec6 error = by_unknown(errors[p], [](double a, double b) { return std::max(a, b); });
    largest[p] =
        std::max(error.head<3>().maxCoeff() / system_.model().length(), error.tail<3>().maxCoeff());
  }
  system_.comm().max(largest);
  const auto known = largest.begin() + static_cast<std::ptrdiff_t>(past_.size()) + 1;
  const auto best = std::min_element(largest.begin(), known);
  if (!past_.empty()) reversal_ += fading * (reversal_of(changes) - reversal_);
  if (past_.size() == max_past) past_.pop_back();
  past_.push_front(std::move(now));
  const bool is_better = *best < least_gain * largest[index(plain())];
  points_ = is_better ? static_cast<int>(best - largest.begin()) : plain();
}

// The velocity goes on as much from the middle of a step to its end as it did from its start.
// Rotations count by a tenth of the length of the model, as along paths.
double Predictor::reversal_of(const VelocityChanges& changes) const {
  const double arm = PathCondition::turning_arm(system_.model());
  const auto sum_of = [&](const NodeRow& row) {
    const Vec6 sums = by_unknown(row, std::plus<>());
    return sums.head<3>().sum() + arm * arm * sums.tail<3>().sum();
  };
  std::array<double, 3> products{sum_of(changes.before), sum_of(changes.after),
                                 sum_of(changes.both)};
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
