#include "coupled_window.hpp"

#include <algorithm>
#include <utility>

namespace culm::simulation {
namespace {

using coupling::bit;
using Eigen::VectorXd;
using port::Quantity;

// Of a window: how near two ends of it may be to count as one.
constexpr double same_end = 1e-9;

}  // namespace

void CoupledWindow::start(int number, double latest) {
  number_ = number;
  start_ = stepper_.time();
  latest_ = latest;
  is_ahead_ = false;
  may_cut_ = true;
  if (length_) stepper_.save(memory_);
}

bool CoupledWindow::go() {
  go_back();
  motions_.assign(sides_.size(), {});
  return length_ ? go_in_steps() : go_in_one();
}

void CoupledWindow::go_back() {
  if (length_ && is_ahead_) stepper_.restore(memory_);
  is_ahead_ = false;
}

void CoupledWindow::accept() {
  if (!length_) stepper_.accept();
  is_open_ = is_ahead_ = false;
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

coupling::Window CoupledWindow::about(std::size_t side, int attempt) const {
  coupling::Window window = motions_[side];
  window.number = number_;
  window.attempt = attempt;
  window.start = start_;
  window.end = end_;
  return window;
}

coupling::Window CoupledWindow::at_rest(std::size_t side) {
  coupling::Window window;
  window.number = number_;
  window.start = start_;
  window.end = proposal();
  complete();
  for (const Quantity q : coupling::all_quantities) {
    if ((sides_[side].wanted & bit(q)) == 0) continue;
    std::vector<double>& values = window.of(q) = sides_[side].port->read(q, stepper_.state());
    if (q == Quantity::velocity) std::fill(values.begin(), values.end(), 0.0);
  }
  return window;
}

VectorXd CoupledWindow::velocity(const CoupledSide& side) {
  complete();
  return translations(side.port->read(Quantity::velocity, stepper_.state()));
}

double CoupledWindow::proposal() const {
  const double wanted =
      length_ ? std::min(start_ + *length_, stepper_.final_time()) : stepper_.proposal();
  return latest_ < wanted - same_end * (wanted - start_) ? latest_ : wanted;
}

bool CoupledWindow::go_in_one() {
  end_ = proposal();
  is_open_ = false;
  report_ = stepper_.attempt(end_);
  is_open_ = true;
  if (report_.accepted) read(true);
  return report_.accepted;
}

bool CoupledWindow::go_in_steps() {
  const double end = proposal();
  const double tolerance = same_end * (end - start_);
  is_ahead_ = true;
  bool has_cut = false;
  while (stepper_.time() < end - tolerance && !stepper_.is_at_end()) {
    const double step = stepper_.proposal();
    const double target = step > end + tolerance ? end : step;
    report_ = stepper_.attempt(target);
    if (report_.accepted) {
      read(target >= end - tolerance);
      stepper_.accept();
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
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    coupling::Window& window = motions_[i];
    for (const Quantity q : coupling::all_quantities) {
      if ((sides_[i].wanted & bit(q)) == 0 || (!is_last && q != Quantity::motion)) continue;
      std::vector<double> values = sides_[i].port->read(q, stepper_.state());
      std::vector<double>& sum = window.of(q);
      if (q != Quantity::motion || sum.empty()) {
        sum = std::move(values);
        continue;
      }
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += values[k];
    }
  }
}

}  // namespace culm::simulation
