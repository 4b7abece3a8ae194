#include "coupled_window.hpp"

#include <culm/math/rotation.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace culm::simulation {
namespace {

using coupling::bit;
using Eigen::VectorXd;

// Of a window of several steps, what is tried at the least.
constexpr double smallest_part = 1.0 / 1024.0;

// Of a window: how near two ends of it may be to count as one.
constexpr double same_end = 1e-9;

// The rotation by a vector |tau| = 2 tan(angle / 2).
Mat3 rotation_of(const Vec3& tau) {
  const double half = 0.5 * tau.norm();
  return exp_rotation(half > 0.0 ? Vec3(std::atan(half) / half * tau) : Vec3(tau));
}

// What a step of culm's own scheme that goes straight makes of the quantities at its start.
void foresee(const Pace& pace, const std::vector<double>& velocity, coupling::Window& window) {
  const double h = window.length();
  const VectorXd mean = pace.guess(h);
  for (Eigen::Index p = 0; p < mean.size() / 6; ++p) {
    const Vec6 rate = mean.segment<6>(6 * p);
    const Eigen::Map<const Vec6> before(velocity.data() + 6 * p);
    const auto six = [&](port::Quantity q, const Vec6& value) {
      std::vector<double>& values = window.of(q);
      if (!values.empty()) Eigen::Map<Vec6>(values.data() + 6 * p) = value;
    };
    six(port::Quantity::motion, h * rate);
    six(port::Quantity::velocity, 2.0 * rate - before);
    six(port::Quantity::acceleration, 2.0 / h * (rate - before));
    std::vector<double>& position = window.of(port::Quantity::position);
    if (!position.empty()) Eigen::Map<Vec3>(position.data() + 3 * p) += h * rate.head<3>();
    std::vector<double>& rotation = window.of(port::Quantity::rotation);
    if (rotation.empty()) continue;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(rotation.data() + 9 * p);
    R = (rotation_of(h * rate.tail<3>()) * R).eval();
  }
}

}  // namespace

void WindowCuts::save(Snapshot& snapshot) const {
  snapshot.set("coupling/cuts", {static_cast<double>(count), shortest, length, end});
}

void WindowCuts::restore(const Snapshot& snapshot) {
  if (!snapshot.has("coupling/cuts")) return;
  const std::span<const double> kept = snapshot.numbers("coupling/cuts", 4);
  count = static_cast<int>(kept[0]);
  shortest = kept[1];
  length = kept[2];
  end = kept[3];
}

CoupledWindow::CoupledWindow(analysis::Stepper& stepper, assembly::System& system,
                             const std::vector<WatchedQuantity>& watched,
                             std::vector<CoupledSide>& sides, std::optional<double> length,
                             WindowCuts& cuts)
    : stepper_(stepper), system_(system), sides_(sides), length_(length), cuts_(cuts) {
  if (length_ && remember(watched)) keeper_.emplace(system_, watched);
}

void CoupledWindow::start(int number, double latest) {
  number_ = number;
  start_ = stepper_.time();
  latest_ = latest;
  is_ahead_ = false;
  may_cut_ = true;
  passed_.clear();
  if (length_) stepper_.save(memory_);
  if (keeper_) keeper_->keep(memory_);
}

bool CoupledWindow::go() {
  go_back();
  motions_.assign(sides_.size(), {});
  return length_ ? go_in_steps() : go_in_one();
}

void CoupledWindow::go_back() {
  if (length_ && is_ahead_) {
    stepper_.restore(memory_);
    if (keeper_) keeper_->go_back(memory_);
    passed_.clear();
  }
  is_ahead_ = false;
}

void CoupledWindow::accept() {
  if (!length_) stepper_.accept();
  is_open_ = is_ahead_ = false;
  if (cuts_.length == 0.0) return;
  // parts grow again, as steps do
  if (end_ >= whole_end() - same_end * *length_) cuts_.end = 0.0;
  cuts_.length *= 2.0;
  if (cuts_.length >= *length_) cuts_.length = cuts_.end = 0.0;
}

bool CoupledWindow::cut() {
  report_.accepted = false;
  double next = cuts_.length > 0.0 || !length_ ? cuts_.length : *length_;
  bool is_possible = false;
  if (length_) {
    constexpr double shorter = 0.75;  // the last part may have been shorter than others
    while (next > shorter * length()) next *= 0.5;
    go_back();
    cuts_.end = whole_end();
    cuts_.length = next;
    is_possible = next >= smallest_part * *length_;
  } else {
    stepper_.fail();
    is_open_ = false;
    next = stepper_.proposal() - start_;
    is_possible = !stepper_.is_exhausted();
  }
  if (!is_possible) return false;
  cuts_.shortest = cuts_.count == 0 ? next : std::min(cuts_.shortest, next);
  ++cuts_.count;
  return true;
}

void CoupledWindow::abandon() {
  go_back();
  if (is_open_) stepper_.discard();
  is_open_ = false;
}

void CoupledWindow::fail() {
  if (!length_) stepper_.fail();
  is_open_ = false;
  if (stepper_.is_exhausted()) stepper_.give_up();
}

std::vector<coupling::Window> CoupledWindow::about(int attempt) const {
  std::vector<coupling::Window> windows = motions_;
  for (coupling::Window& window : windows) {
    window.number = number_;
    window.attempt = attempt;
    window.start = start_;
    window.end = end_;
  }
  return windows;
}

// With the velocities of the start.
std::vector<coupling::Window> CoupledWindow::unmoved() {
  complete();
  std::vector<coupling::Window> windows;
  for (const CoupledSide& side : sides_) {
    coupling::Window& window = windows.emplace_back();
    window.number = number_;
    window.start = start_;
    window.end = proposal();
    for (const port::Quantity q : coupling::all_quantities) {
      if ((side.wanted & bit(q)) != 0) window.of(q) = side.port->read(q, stepper_.state());
    }
  }
  return windows;
}

std::vector<coupling::Window> CoupledWindow::at_rest() {
  std::vector<coupling::Window> windows = unmoved();
  for (coupling::Window& window : windows) {
    std::vector<double>& velocity = window.of(port::Quantity::velocity);
    std::fill(velocity.begin(), velocity.end(), 0.0);
  }
  return windows;
}

std::vector<coupling::Window> CoupledWindow::foreseen() {
  std::vector<coupling::Window> windows = unmoved();
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const port::Port& port = *sides_[i].port;
    const std::vector<double> velocity = port.read(port::Quantity::velocity, stepper_.state());
    foresee(sides_[i].pace, velocity, windows[i]);
  }
  return windows;
}

void CoupledWindow::enter() {
  complete();
  for (CoupledSide& side : sides_) {
    const std::vector<double> velocity =
        side.port->read(port::Quantity::velocity, stepper_.state());
    side.velocity = translations(velocity);
    if (stepper_.steps() == 0) side.pace.start(velocity);
  }
}

// Where a window of several steps ends if it is not cut.
double CoupledWindow::whole_end() const {
  return cuts_.end > 0.0 ? cuts_.end : std::min(start_ + *length_, stepper_.final_time());
}

double CoupledWindow::proposal() const {
  double wanted = length_ ? whole_end() : stepper_.proposal();
  if (cuts_.length > 0.0) {
    // parts end at fractions of the window, where the grid of the steps has no slivers
    const double parts = std::ceil((wanted - start_) / cuts_.length - same_end) - 1.0;
    wanted -= std::max(0.0, parts) * cuts_.length;
  }
  return latest_ < wanted - same_end * (wanted - start_) ? latest_ : wanted;
}

bool CoupledWindow::go_in_one() {
  end_ = proposal();
  is_open_ = false;
  report_ = stepper_.attempt(end_);
  is_open_ = true;
  shortest_step_ = end_ - start_;
  if (report_.accepted) read(true);
  return report_.accepted;
}

bool CoupledWindow::go_in_steps() {
  const double end = proposal();
  const double tolerance = same_end * (end - start_);
  bool has_cut = false;
  shortest_step_ = end - start_;
  while (stepper_.time() < end - tolerance && !stepper_.is_at_end()) {
    if (is_ahead_) passed_.push_back(report_);
    is_ahead_ = true;
    const double step = stepper_.proposal();
    const double target = step > end + tolerance ? end : step;
    report_ = stepper_.attempt(target);
    if (report_.accepted) {
      read(target >= end - tolerance);
      shortest_step_ = std::min(shortest_step_, target - stepper_.time());
      stepper_.accept();
      if (keeper_) keeper_->step(report_, stepper_.state());
      report_.is_last = stepper_.is_at_end();
    } else {
      stepper_.fail();
      has_cut = true;
      if (!may_cut_ || stepper_.is_exhausted()) return false;
    }
  }
  end_ = stepper_.time();
  may_cut_ = has_cut;
  return true;
}

// The state with both ends of the step, on all ranks.
void CoupledWindow::complete() {
  system_.synchronise(stepper_.state());
  system_.complete(stepper_.state().prev);
}

// Motions add up over the steps; all else is that of the last one.
void CoupledWindow::read(bool is_last) {
  complete();
  const model::State& state = stepper_.state();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    coupling::Window& window = motions_[i];
    for (const port::Quantity q : coupling::all_quantities) {
      if ((sides_[i].wanted & bit(q)) == 0 || (!is_last && q != port::Quantity::motion)) continue;
      std::vector<double> values = sides_[i].port->read(q, state);
      std::vector<double>& sum = window.of(q);
      if (q == port::Quantity::motion && length_) {
        window.steps.push_back({state.time_prev, state.time, values});
      }
      if (q != port::Quantity::motion || sum.empty()) {
        sum = std::move(values);
        continue;
      }
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += values[k];
    }
  }
}

}  // namespace culm::simulation
