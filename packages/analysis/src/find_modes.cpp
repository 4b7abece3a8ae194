#include <culm/analysis/find_modes.hpp>
#include <culm/analysis/relaxing_modes.hpp>
#include <culm/base/error.hpp>
#include <culm/solver/eigen_solver.hpp>

#include "hidden_asymmetry.hpp"
#include "whole_matrix.hpp"
#include "zero_modes.hpp"

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace culm::analysis {
namespace {

using Complex = std::complex<double>;

// Eigenvalues below so many times their rounding are zero; found ones are a tenth of it.
constexpr double zero_bound = 4.0;

// Of a tangent, above rounding.
constexpr double least_asymmetry = 1e-12;

// Where hidden frequencies reach this share of the lowest one, that is off by 1e-3 and more.
constexpr double notable_share = 0.3;

// Of the lowest frequency, that a state may turn with before its modes see it.
constexpr double notable_turning = 1e-2;

// How fast directors of this rank turn, at most [rad/s].
double fastest_turn(const model::State& state) {
  if (state.velocity.empty()) return 0.0;
  double fastest = 0.0;
  const auto nodes = static_cast<int>(state.velocity.size() / 12);
  for (int node = 0; node < nodes; ++node) {
    const auto rates = model::NodeTable::slots(state.velocity, node).rightCols<3>();
    fastest = std::max(fastest, rates.colwise().norm().maxCoeff());
  }
  return fastest;
}

// Multiplies a vector, whose factor is arbitrary, so that the largest displacement, or else the
// largest rotation, is positive and real. Of components that differ by rounding the first decides.
void fix_phase(Shape& shape) {
  const auto at = [&](std::size_t node, int i) {
    return Complex(shape.real[node][i], shape.imaginary.empty() ? 0.0 : shape.imaginary[node][i]);
  };
  const auto largest = [&](int first) {
    double size = 0.0;
    for (std::size_t node = 0; node < shape.real.size(); ++node) {
      for (int i = first; i < first + 3; ++i) size = std::max(size, std::abs(at(node, i)));
    }
    return size;
  };
  const double displacement = largest(0);
  const double rotation = largest(3);
  const int first = displacement > 1e-6 * rotation ? 0 : 3;
  const double size = first == 0 ? displacement : rotation;
  const auto phase_of_first = [&]() -> Complex {
    for (std::size_t node = 0; node < shape.real.size(); ++node) {
      for (int i = first; i < first + 3; ++i) {
        const Complex one = at(node, i);
        if (std::abs(one) > 0.0 && std::abs(one) >= 0.999 * size) return one / std::abs(one);
      }
    }
    return 1.0;
  };
  const Complex factor = std::conj(phase_of_first());
  for (std::size_t node = 0; node < shape.real.size(); ++node) {
    if (shape.imaginary.empty()) {
      shape.real[node] *= factor.real();
      continue;
    }
    const Vec6 real = factor.real() * shape.real[node] - factor.imag() * shape.imaginary[node];
    shape.imaginary[node] =
        factor.real() * shape.imaginary[node] + factor.imag() * shape.real[node];
    shape.real[node] = real;
  }
}

int sign_of_determinant(SparseMatrix matrix) {
  matrix.makeCompressed();
  Eigen::SparseLU<SparseMatrix> factors;
  factors.compute(matrix);
  if (factors.info() != Eigen::Success) return 0;
  return factors.signDeterminant() > 0.0 ? 1 : -1;
}

std::string name_of(std::size_t number, const Mode& mode) {
  if (mode.is_zero()) return fmt::format("mode {}, 0 Hz", number);
  if (mode.frequency() == 0.0) {
    return fmt::format("mode {}, {}", number,
                       mode.eigenvalue.real() > 0.0 ? "unstable" : "overdamped");
  }
  return fmt::format("mode {}, {:.4g} Hz", number, mode.frequency());
}

class Finder {
 public:
  Finder(Context& context, model::State& state, const ModalSettings& settings)
      : context_(context), state_(state), settings_(settings), linear_(linearise(context, state)) {
    context.system.synchronise(state);
    refuse_massless();
    if (settings.rotor) {
      rotor_.emplace(context.system, state, *settings.rotor);
      linear_ = rotor_->transform(linear_, settings.damping);
      set_.rotor_speed = rotor_->speed();
    } else {
      warn_of_turning_part(context.system.model(), context.log);
    }
    solver_.solver = settings.solver;
    solver_.linear_solver = context.linear.name();
    solver_.count = settings.modes;
  }

  ModeSet find() {
    const bool counts = settings_.damping || rotor_;  // a rotor keeps gyroscopic forces alone
    rates_ = counts ? linear_.damping : rates_of_signals(context_.system, linear_.damping);
    relaxes_ = settings_.damping && !linear_.branches.empty();
    set_.is_complex = linear_.asymmetry > largest_asymmetry || rates_ || relaxes_;
    if (!counts && damps_motions(context_.system, linear_.damping)) {
      context_.log.info(
          "note: modes are those without damping and gyroscopic forces; 'Damping' = true counts "
          "them");
    }
    set_.is_complex ? find_complex() : find_real();
    if (settings_.stiffness_sign) {
      set_.stiffness_sign = sign_of_determinant(whole(*linear_.stiffness, context_.system.comm()));
    }
    if (!settings_.expects_zero) warn_of_rounding();
    warn_of_relaxation();
    warn_of_motion();
    const ModeMasses masses(context_.system.model(), state_);
    set_.total = masses.total();
    for (std::size_t i = 0; i < set_.modes.size(); ++i) {
      Mode& mode = set_.modes[i];
      fix_phase(mode.shape);
      mode.shape.name = name_of(i + 1, mode);
      mode.properties = masses.properties(mode.shape);
    }
    return std::move(set_);
  }

 private:
  void refuse_massless() const {
    double largest = 0.0;
    for (const double value : linear_.mass->values()) {
      largest = std::max(largest, std::abs(value));
    }
    if (context_.system.comm().max(largest) > 0.0) return;
    throw NumericalError(
        "There are no vibrations: nothing that can move has mass.\n"
        "Try: give structures a density or mass, or hold less of them.");
  }

  // Just below zero, so that free bodies have factors, too.
  double lowest_shift() const { return -1e-10 * typical_eigenvalue(linear_, context_.system); }

  std::vector<Vec6> motions(const Eigen::VectorXd& unknowns) const {
    return node_motions(context_.system, state_,
                        rotor_ ? rotor_->unknowns(unknowns) : Eigen::VectorXd(unknowns));
  }

  void add(Mode mode, const Eigen::VectorXcd& x) {
    if (rotor_) mode.whirl = rotor_->whirl(x);
    set_.modes.push_back(std::move(mode));
  }

  void find_real() {
    solver_.shift =
        settings_.near ? std::pow(2.0 * std::numbers::pi * *settings_.near, 2) : lowest_shift();
    auto pairs = solver::solve_eigenproblem({linear_.stiffness, linear_.mass}, solver_,
                                            context_.system.comm());
    if (is_hidden_asymmetry(pairs)) {
      set_.is_complex = true;
      find_complex();
      return;
    }
    separate_zero_modes(pairs);
    for (std::size_t i = 0; i < pairs.values.size(); ++i) {
      const double square = pairs.values[i];
      Mode mode;
      if (!is_zero(pairs, i)) {
        mode.eigenvalue = square > 0.0 ? Complex(0.0, std::sqrt(square)) : std::sqrt(-square);
      }
      const Eigen::VectorXd x = pairs.vectors.col(static_cast<Eigen::Index>(i));
      mode.shape.real = motions(x);
      add(std::move(mode), x.cast<Complex>());
    }
    note_rounding(pairs.rounding);
    tell(pairs);
    set_.solver = pairs.solver;
    set_.worst_residual = pairs.worst_residual;
  }

  static bool is_zero(const solver::EigenPairs& pairs, std::size_t i) {
    return std::abs(pairs.values[i]) <= zero_bound * pairs.rounding[i];
  }

  // Modes at 0 Hz may be combined at will, and which combinations are found is rounding.
  void separate_zero_modes(solver::EigenPairs& pairs) const {
    std::vector<Eigen::Index> zeros;
    std::vector<std::vector<Vec6>> shapes;
    for (std::size_t i = 0; i < pairs.values.size(); ++i) {
      if (!is_zero(pairs, i)) continue;
      zeros.push_back(static_cast<Eigen::Index>(i));
      shapes.push_back(motions(pairs.vectors.col(zeros.back())));
    }
    if (zeros.size() < 2) return;
    pairs.vectors(Eigen::all, zeros) = pairs.vectors(Eigen::all, zeros) *
                                       combine_zero_modes(shapes, context_.system.model(), state_);
  }

  // What is so little of the tangent may be all that its modes feel.
  bool is_hidden_asymmetry(const solver::EigenPairs& pairs) const {
    if (linear_.asymmetry <= least_asymmetry) return false;
    std::vector<double> squares = pairs.values;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      if (is_zero(pairs, i)) squares[i] = 0.0;
    }
    const parallel::Comm& comm = context_.system.comm();
    return hides_asymmetry(whole(*linear_.stiffness, comm), whole(*linear_.mass, comm), squares,
                           pairs.vectors);
  }

  void find_complex() {
    std::shared_ptr<const assembly::Matrix> damping = rates_;
    if (!damping) {
      const auto none = std::make_shared<assembly::Matrix>(*linear_.mass);
      std::ranges::fill(none->values(), 0.0);
      damping = none;
    }
    if (settings_.near) {
      throw NumericalError(
          "Modes next to a frequency are looked for among undamped ones only. Here damping, forces "
          "that follow, spin or air make them complex.\n"
          "Try: leave 'Near' out, with so many 'Modes' that the lowest ones reach there.");
    }
    solver_.shift = std::sqrt(-lowest_shift());
    auto pairs = solver::solve_quadratic({linear_.stiffness, damping, linear_.mass}, solver_,
                                         context_.system.comm());
    if (relaxes_) follow_branches(*damping, pairs);
    for (std::size_t i = 0; i < pairs.values.size(); ++i) {
      Mode mode;
      if (!is_zero(pairs, i)) {
        mode.eigenvalue = pairs.values[i];
        if (!oscillates(mode.eigenvalue)) mode.eigenvalue.imag(0.0);
      }
      const Eigen::VectorXcd x = pairs.vectors.col(static_cast<Eigen::Index>(i));
      mode.shape.real = motions(x.real());
      mode.shape.imaginary = motions(x.imag());
      add(std::move(mode), x);
    }
    note_rounding(pairs.rounding);
    tell(pairs);
    set_.solver = pairs.solver;
    set_.worst_residual = pairs.worst_residual;
  }

  // A real value has no frequency but for rounding.
  static bool oscillates(Complex value) { return value.imag() >= 1e-9 * std::abs(value); }

  static bool is_zero(const solver::ComplexPairs& pairs, std::size_t i) {
    return solver::is_zero(pairs.values[i], pairs.rounding[i]);
  }

  RelaxingPencil relaxing_pencil(const assembly::Matrix& damping) const {
    const parallel::Comm& comm = context_.system.comm();
    RelaxingPencil pencil{
        whole(*linear_.stiffness, comm), whole(damping, comm), whole(*linear_.mass, comm), {}};
    for (const LinearBranches& branch : linear_.branches) {
      add_terms(whole(*branch.stiffness, comm), branch.time, false, pencil);
      if (!branch.damping) continue;
      add_terms(whole(*branch.damping, comm), branch.time, true, pencil);
    }
    return pencil;
  }

  void add_terms(SparseMatrix branches, double time, bool of_velocity,
                 RelaxingPencil& pencil) const {
    branches.prune(0.0);
    if (branches.nonZeros() == 0) return;
    if (!rotor_) {
      pencil.terms.push_back({branches.cast<Complex>(), time, 0.0, of_velocity});
      return;
    }
    for (BranchTerm& term : rotor_->terms_of(branches, time, of_velocity)) {
      pencil.terms.push_back(std::move(term));
    }
  }

  // From the modes of the lasting stiffness to those with branches, by their size again.
  void follow_branches(const assembly::Matrix& damping, solver::ComplexPairs& pairs) {
    const RelaxingPencil pencil = relaxing_pencil(damping);
    std::vector<ComplexMode> modes;
    for (std::size_t i = 0; i < pairs.values.size(); ++i) {
      ComplexMode mode{pairs.values[i], pairs.vectors.col(static_cast<Eigen::Index>(i))};
      if (!is_zero(pairs, i)) {
        mode = compute_relaxing_mode(pencil, mode);
        pairs.worst_residual = std::max(pairs.worst_residual, mode.residual);
        const double mass = mode.vector.dot(pencil.M * mode.vector).real();
        if (mass > 0.0) mode.vector /= std::sqrt(mass);
      }
      modes.push_back(std::move(mode));
    }
    warn_of_doubles(pencil, modes);
    std::vector<std::size_t> order(modes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::abs(modes[i].value); });
    const std::vector<double> rounding = pairs.rounding;
    for (std::size_t i = 0; i < order.size(); ++i) {
      pairs.values[i] = modes[order[i]].value;
      pairs.vectors.col(static_cast<Eigen::Index>(i)) = modes[order[i]].vector;
      pairs.rounding[i] = rounding[order[i]];
    }
    pairs.solver += ", branches by Newton's method";
  }

  // Two vibrations without branches may lead to one with them; the other is missing then. Of
  // motions that only decay or grow branches have others of their own, and none of them is looked
  // for.
  void warn_of_doubles(const RelaxingPencil& pencil, const std::vector<ComplexMode>& modes) const {
    for (std::size_t i = 0; i < modes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double apart = std::abs(modes[i].value - modes[j].value);
        if (apart > 1e-8 * std::abs(modes[i].value) || modes[i].value == 0.0) continue;
        if (!oscillates(modes[i].value)) continue;
        if (std::abs(modes[i].vector.dot(pencil.M * modes[j].vector)) < 1.0 - 1e-6) continue;
        context_.findings.warn(
            "relaxation",
            fmt::format("two modes of the lasting stiffness became the one at {:.6g} Hz; another "
                        "next to it is missing: look at the modes without 'Damping'",
                        std::abs(modes[i].value.imag()) / (2.0 * std::numbers::pi)),
            state_.time);
      }
    }
  }

  // What the eigensolver had to do, and what is missing.
  template <class Pairs>
  void tell(const Pairs& pairs) const {
    if (!pairs.note.empty()) context_.log.info("note: " + pairs.note);
    const auto asked = static_cast<std::size_t>(solver_.count);
    if (pairs.values.size() >= asked) return;
    if (!pairs.are_all) {
      throw NumericalError(
          fmt::format("The eigenproblem was not solved: {} of {} modes were found.\n"
                      "Try: fewer modes, or 'Solver' = Dense.",
                      pairs.values.size(), asked));
    }
    context_.log.info(fmt::format("note: {} modes were asked for, but the model has {} only", asked,
                                  pairs.values.size()));
  }

  void note_rounding(const std::vector<double>& rounding) {
    for (double of_square : rounding) {
      hidden_ = std::max(hidden_, std::sqrt(zero_bound * of_square) / (2.0 * std::numbers::pi));
    }
  }

  void warn_of_relaxation() const {
    if (relaxes_ || linear_.branches.empty()) return;
    context_.findings.warn(
        "relaxation",
        "frequencies are those of the lasting stiffness, without the branches of "
        "'Relaxation' and the lag of air; 'Damping' = true counts them",
        state_.time);
  }

  // Velocities of the state have no part in the equations.
  void warn_of_motion() const {
    const double turning = context_.system.comm().max(fastest_turn(state_));
    double lowest = std::numeric_limits<double>::infinity();
    for (const Mode& mode : set_.modes) {
      if (!mode.is_zero()) lowest = std::min(lowest, std::abs(mode.eigenvalue));
    }
    if (!(turning > notable_turning * lowest)) return;
    context_.findings.warn(
        "no equilibrium",
        fmt::format(
            "the state is in motion and turns by up to {:.3g} rad/s, but modes are those of "
            "a structure that stands still there, without gyroscopic and centrifugal "
            "forces: describe what turns in a 'Rotating Frame'",
            turning),
        state_.time);
  }

  // Stiff directions leave their rounding in soft ones.
  void warn_of_rounding() const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Mode& mode : set_.modes) {
      const double frequency = std::abs(mode.eigenvalue) / (2.0 * std::numbers::pi);
      if (!mode.is_zero()) lowest = std::min(lowest, frequency);
    }
    if (std::isinf(lowest)) {
      warn_of_silence();
      return;
    }
    if (hidden_ <= notable_share * lowest) return;
    context_.findings.warn(
        "hidden modes",
        fmt::format("rounding hides frequencies below {:.2g} Hz, and those next to it are inexact: "
                    "stiffnesses differ too much in size",
                    hidden_),
        state_.time);
  }

  // Nothing but zeros: right for what floats freely, or has joints without stiffness.
  void warn_of_silence() const {
    const bool floats = std::ranges::all_of(
        set_.modes, [&](const Mode& mode) { return is_rigid(mode.shape, state_.next); });
    if (floats) return;
    context_.findings.warn(
        "hidden modes",
        fmt::format("all {} modes are at 0 Hz within rounding, which hides frequencies below "
                    "{:.2g} Hz, and not all of them are motions of the whole as a rigid body: "
                    "mechanisms, or vibrations that are lost because stiffnesses differ too much "
                    "in size; ask for more modes, or make what is very stiff rigid",
                    set_.modes.size(), hidden_),
        state_.time);
  }

  Context& context_;
  model::State& state_;
  const ModalSettings& settings_;
  Linearisation linear_;
  std::optional<TurningRotor> rotor_;
  std::shared_ptr<const assembly::Matrix> rates_;  // what counts of the damping
  solver::EigenSettings solver_;
  bool relaxes_ = false;  // whether branches count
  ModeSet set_;
  double hidden_ = 0.0;  // frequency that may be nothing but rounding [Hz]
};

}  // namespace

double Mode::frequency() const { return eigenvalue.imag() / (2.0 * std::numbers::pi); }

// not -0 of what is not damped
double Mode::damping() const {
  return is_zero() ? 0.0 : 0.0 - eigenvalue.real() / std::abs(eigenvalue);
}

std::string describe(const Mode& mode, const model::Model& model) {
  std::string text = describe_shares(model, mode.properties.energy);
  if (!mode.whirl) return text;
  const std::pair<const char*, double> patterns[] = {{"collective", mode.whirl->collective},
                                                     {"backward whirl", mode.whirl->backward},
                                                     {"forward whirl", mode.whirl->forward}};
  const auto& most = *std::ranges::max_element(
      patterns, {}, [](const auto& pattern) { return std::lround(1e3 * pattern.second); });
  if (most.second > 0.05) text += fmt::format("; {} {:.0f} %", most.first, 100.0 * most.second);
  return text;
}

ModeSet find_modes(Context& context, model::State& state, const ModalSettings& settings) {
  return Finder(context, state, settings).find();
}

}  // namespace culm::analysis
