/// Whether a run kept what its scheme promises.
#pragma once

#include <culm/analysis/books.hpp>
#include <culm/assembly/system.hpp>
#include <culm/base/snapshot.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::analysis {

/// Follows energy and momenta through a dynamic run and balances them against loads, drives,
/// dampers and dissipation, with the shares of the accounts that they book under (`model::Booked`).
/// @source formulation 4.3, 4.6
class Certificate {
 public:
  /// @param promises whether the scheme balances energy and momenta exactly
  /// @param shows_work whether what its forces do in a step is their work
  Certificate(const assembly::System& system, bool promises, bool shows_work);

  void start(const model::State& state);
  /// In each accepted step, before anything of it moves on: sums work and impulses.
  void add_work(const model::State& state, const Stencil& stencil, double constraint_violation);
  /// What drives do beyond the work of the step, where a corner of a prescribed motion makes
  /// velocities jump [J].
  void add_blow(double work);
  /// Whether balances are to be compared after this step, as after every tenth.
  bool is_due() const;
  /// After a step was accepted: compares balances.
  void compare(const model::State& state);
  /// Where the run stands at its end, wherever that is.
  void compare_last(const model::State& state);

  /// Once at the end, if it can be told. Constraints hold for positions; their rates, H v = dg/dt,
  /// hold to the second order of the step only. @param change largest change of the velocity that
  /// makes them hold
  /// @param velocity the largest one, of the end or usual before [m/s, 1/s]
  void finish(double change, double velocity);

  /// Before the end, if it is asked for: what rounding alone may move in one step [J]. Where
  /// nothing moves more than that adds up to, drifts are those of rounding over rounding, and not
  /// judged.
  void set_rounding(double energy) { rounding_ = energy; }

  /// All that was summed and compared so far, as "certificate".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

  /// The largest of the mean speeds sqrt(2 T / m) that were compared so far [m/s]; 0 without mass.
  double largest_mean_speed() const;

  /// Whether nothing holds the model from outside, so that its momenta are kept.
  bool is_free() const { return is_free_; }

  /// The promises that do not hold, as "energy balance 2.1e-07 (kept up to 1e-09)"; empty if all
  /// do.
  std::string broken() const;
  /// A table for the user: balances, drifts, verdicts.
  std::string text() const;
  /// The same as numbers.
  std::vector<std::pair<std::string, double>> numbers() const;

 private:
  /// A line of the table with a verdict.
  struct Line {
    std::string name;
    double drift = 0.0;  ///< relative
    double promise = 0.0;
    std::string excuse = {};  ///< why it is not promised; empty where it is
  };

  /// A row of what flowed in or out, and the shares that are not zero, by account.
  struct Amount {
    std::string name;
    double value = 0.0;  ///< [J]
    std::vector<std::pair<std::string, double>> shares;
  };

  template <class Self>
  static auto memory(Self& self);
  std::vector<Amount> amounts() const;
  std::vector<Line> lines() const;
  double largest_energy() const;
  double energy_scale() const;
  double moved_by_rounding() const;
  void look_at(const model::State& state);
  double closing_energy(const model::State& state) const;
  std::string excuse(bool is_rounding) const;
  double linear_scale() const;
  double angular_scale() const;

  const assembly::System& system_;
  bool promises_;
  bool shows_work_;
  bool is_free_;
  assembly::Energies first_, last_;
  model::Momentum first_momentum_, momentum_;
  Books books_;
  model::StepWork work_;  ///< summed over all steps
  Vec3 impulse_ = Vec3::Zero();
  Vec3 angular_impulse_ = Vec3::Zero();
  double largest_kinetic_ = 0.0, largest_strain_ = 0.0;
  double largest_amount_ = 0.0;  ///< sum of the sizes of all energies [J]
  double largest_work_ = 0.0;
  double closing_ = 0.0;  ///< what constraints hold that do not hold exactly at the start [J]
  double largest_linear_ = 0.0, largest_angular_ = 0.0;
  double pushed_linear_ = 0.0, pushed_angular_ = 0.0;  ///< impulses, whichever way they act
  double energy_drift_ = 0.0;                          ///< largest defect of the balance [J]
  double linear_drift_ = 0.0;                          ///< [N s]
  double angular_drift_ = 0.0;                         ///< [N m s]
  double constraint_violation_ = 0.0;
  std::optional<double> hidden_violation_;
  double rounding_ = 0.0;
  int steps_ = 0;
};

}  // namespace culm::analysis
