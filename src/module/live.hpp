/// Simulations and steppers in the hands of a Python program.
#pragma once

#include <culm/base/error.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/solver/newton_solver.hpp>

#include <pybind11/pybind11.h>

#include <array>
#include <atomic>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace culm::module {

namespace py = pybind11;

using analysis::Stepper;
using simulation::Simulation;

/// MPI and Trilinos, from the import of the module to the end of Python.
class Start {
 public:
  Start() : session_(count_, values_) {}

 private:
  std::array<char, 7> name_{"python"};
  std::array<char*, 2> arguments_{name_.data(), nullptr};
  int count_ = 1;
  char** values_ = arguments_.data();
  simulation::Session session_;
};

/// What the module keeps until Python ends, and each simulation as long as it lives.
inline std::shared_ptr<Start>& start() {
  static std::shared_ptr<Start> kept;
  return kept;
}

/// Keeps what culm says, and makes of each alarm a warning of Python at once.
class Ear final : public std::stringbuf {
 public:
  /// What was heard since the last call.
  std::string take() {
    std::string text = str();
    str({});
    told_ = 0;
    return text;
  }

 private:
  // Once for each message.
  int sync() override {
    const std::string text = str();
    const std::string message = text.substr(told_, text.find_last_not_of('\n') + 1 - told_);
    told_ = text.size();
    if (!message.starts_with("warning: ") && !message.starts_with("error: ")) return 0;
    const py::gil_scoped_acquire held;
    const std::string words = message.substr(message.find(' ') + 1);
    // where warnings are errors of Python: it is not allowed to throw through a log
    if (PyErr_WarnEx(PyExc_UserWarning, words.c_str(), 1) != 0) PyErr_WriteUnraisable(nullptr);
    return 0;
  }

  std::size_t told_ = 0;
};

/// Who solves. The interpreter is free then, and another thread that came in would find or change
/// what is half done.
class Busy {
 public:
  explicit Busy(std::atomic<bool>& solves) : solves_(solves) {
    if (solves_.exchange(true)) refuse();
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() { solves_ = false; }

  [[noreturn]] static void refuse() {
    throw UsageError("another thread is in this simulation: one at a time may be");
  }

 private:
  std::atomic<bool>& solves_;
};

/// Lets Ctrl-C end a run between two steps; the last accepted one stays.
class Interruptible final : public analysis::Observer {
 public:
  void step(const analysis::StepReport&, culm::model::State&) override {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
};

/// A simulation and what it says.
class Live {
 public:
  Live(const std::string& deck, std::vector<std::string> overrides)
      : start_(start()),
        simulation_(Simulation::open(deck, std::move(overrides), Log(said_, LogLevel::info))) {}

  /// What was said since the last call.
  std::string messages() {
    refuse_if_busy();
    return ear_.take();
  }

  /// Tries a step. Why it failed is known until the next one.
  bool attempt(Stepper& stepper, double target) {
    const Busy busy(solves_);
    failure_.clear();
    const double from = stepper.time();
    const analysis::StepReport& report = stepper.attempt(target);
    if (report.accepted) return true;
    std::ostringstream text;
    text << solver::describe(report.outcome.end) << ", from " << from << " to " << target
         << ", after " << report.outcome.iterations << " iterations; relative force residuals:";
    for (const auto& record : report.outcome.history) text << ' ' << record.force;
    failure_ = text.str();
    return false;
  }
  const std::string& failure() const { return failure_; }
  Simulation& simulation() {
    refuse_if_busy();
    return simulation_;
  }
  std::atomic<bool>& solves() { return solves_; }
  void refuse_if_busy() const {
    if (solves_) Busy::refuse();
  }

  void begin(const std::string& analysis) {
    const Busy busy(solves_);
    simulation_.begin(analysis);
  }
  std::string close_results() {
    refuse_if_busy();
    return simulation_.close_results();
  }
  long taken_up() const { return simulation_.taken_up(); }
  Stepper* stepper() { return simulation_.stepper(); }

 private:
  std::shared_ptr<Start> start_;  // the last to go
  Ear ear_;
  std::ostream said_{&ear_};
  Simulation simulation_;
  std::string failure_;
  std::atomic<bool> solves_ = false;
};

/// The stepper of an analysis, as long as it is taken up.
class Handle {
 public:
  explicit Handle(Live& live) : live_(live), number_(live.taken_up()) {}

  Stepper& get() const {
    if (live_.taken_up() != number_ || live_.stepper() == nullptr) {
      throw UsageError("this analysis has ended");
    }
    return *live_.stepper();
  }
  Stepper* operator->() const { return &get(); }
  /// For what changes the state.
  Stepper& take() const {
    live_.refuse_if_busy();
    return get();
  }
  Live& live() const { return live_; }
  bool is_of(const Handle& other) const {
    return &live_ == &other.live_ && number_ == other.number_;
  }

 private:
  Live& live_;
  long number_;
};

/// What a stepper saved, and which one.
struct Saved {
  Handle stepper;
  Snapshot snapshot = Snapshot(Snapshot::Use::memory);
};

}  // namespace culm::module
