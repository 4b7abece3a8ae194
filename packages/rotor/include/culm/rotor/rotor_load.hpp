/// What a turning rotor induces at the strips of its blades.
#pragma once

#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/rotor/dynamic_inflow.hpp>
#include <culm/rotor/losses.hpp>
#include <culm/strip/strip_load.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::rotor {

/// How the induced velocity follows the balance of momentum.
enum class Follow {
  none,     ///< nothing is induced
  frozen,   ///< it stays what it is in the first step of a motion
  steady,   ///< at once
  dynamic,  ///< with the lags of Oye
};

/// Which effects a rotor has.
struct RotorModel {
  Follow follow = Follow::dynamic;
  Losses losses = {};
  bool drag_induces = true;  ///< drag counts in the momentum balance
  bool skewed_wake = true;   ///< Pitt and Peters
};

/// Where a rotor turns: the axis is carried by the node of the hub.
struct RotorHub {
  int node = -1;
  Vec3 axis = Vec3::Zero();  ///< unit vector downwind, in the directors of the node
};

/// A rotor in a step; means are over the stations, by the area of their annuli.
struct RotorState {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 axis = Vec3::Zero();    ///< unit vector downwind
  double speed = 0.0;          ///< about the axis, with its sign [rad/s]
  Vec3 wind = Vec3::Zero();    ///< mean against the hub, without induction [m/s]
  double induction = 0.0;      ///< mean of a, as the momentum balance asks for it [-]

  static constexpr std::size_t size = 11;
  void save(std::span<double> numbers) const;
  void restore(std::span<const double> numbers);
};

/// Blade element and momentum, at each station of the strips of its blades by itself: wind, motion
/// and attitude of the deformed blade in the middle of the step give the balance, its induced
/// velocity is set at the station, with its derivative by the motion of the station. It has no
/// forces of its own. The balance is computed anew in each iteration, from the angle of the one
/// before; what the hub and other stations do to it is left out of the tangent. What it remembers
/// changes in `accept` alone. Induction is good for rotors that turn: it fades out between tip
/// speeds of twice and of once the wind, so in statics there is none, but in a frame that turns.
/// Linearisations have the lags of the wake as lags of each station. Every rank computes all of it.
/// @source fluids B3
class RotorLoad final : public model::MemorylessBatch,
                        public model::LimitedRange,
                        public strip::Inducer {
 public:
  /// @param blades  one strip load per blade, each of at least two stations from the root to the
  ///                tip; they must outlive the rotor's last evaluation, as loads of a model do
  RotorLoad(model::Effect effect, const model::NodeTable& nodes, RotorHub hub,
            std::vector<strip::StripLoad*> blades, RotorModel kind);

  const std::vector<strip::StripLoad*>& blades() const { return blades_; }
  const RotorModel& kind() const { return kind_; }
  /// Where blades end, from the axis in the reference [m].
  double tip_radius() const { return tip_radius_; }
  double density() const { return blades_.front()->flow().density(); }
  /// How far the hub has turned about the axis since the reference, as it is seen along the axis,
  /// from 0 to 2 pi; an axis that leans otherwise got there the shortest way [rad].
  double azimuth(const model::Coordinates& q) const;
  /// In the last accepted step; nothing before the first one, on all ranks alike.
  std::optional<RotorState> state() const;

  void induce(const model::State& state, const Stencil& stencil) override;

  int size() const override { return 0; }
  std::vector<int> blocks(int, const model::UnknownTable&) const override { return {}; }
  bool has_tangent() const override { return false; }
  bool needs_all_nodes() const override { return true; }
  void prepare(const model::State& state, const Stencil& stencil) override;
  Verdict assemble(const model::State&, const Stencil&, Want, model::Target&) override {
    return Verdict::ok;
  }
  void accept(model::State& state) override;
  /// The angle between wind and axis over 45 degrees, where the correction for skewed wakes ends;
  /// or one of `Misuse`, the largest that there is.
  double range_used() const override;
  std::string range_warning(double used) const override;
  model::StepWork step_work(const model::State&, const Stencil&) const override { return {}; }

  std::size_t memory_size() const override;
  void save(model::Items items, std::span<double> numbers) const override;
  void restore(std::span<const double> numbers) override;

 private:
  /// What is worse than a skewed wake, as values of `range_used`.
  struct Misuse {
    static constexpr double unbalanced = 3.0;  ///< stations that should have a balance have none
    static constexpr double other_turn =
        4.0;                               ///< blades do not turn as the hub does about the axis
    static constexpr double uneven = 5.0;  ///< blades are not evenly spaced about it
  };
  /// A station, and what does not change there.
  struct Element {
    strip::StripLoad* strip = nullptr;
    int station = 0;
    double radius = 0.0;                        ///< from the axis in the reference [m]
    double area = 0.0;                          ///< of its part of the annulus [m^2]
    double hub_radius = 0.0, tip_radius = 0.0;  ///< of its blade [m]
  };
  /// What goes on from step to step.
  struct Memory {
    bool has_stepped = false;
    bool has_wake = false;  ///< a step in time was accepted
    RotorState seen;
    int unbalanced = 0;             ///< stations that should have a balance, and have none
    double turning = 0.0;           ///< share of the balance that counts
    bool turns_otherwise = false;   ///< most of the speed of the blades is another than the hub's
    std::vector<InflowState> wake;  ///< by element
    std::vector<double> angles;     ///< of inflow, where the next balance is looked for; 0: nowhere
  };
  /// By velocity, turning and rotation of a station (`strip::InducedVelocity`).
  using Slope = Eigen::Matrix<double, 1, 9>;
  /// A station with its balance, in the plane of its section.
  struct Balanced {
    Vec3 outwards, normal, against;  ///< unit vectors: from the axis, of the rotor, of wind
    bool found = true;
    double angle = 0.0;                      ///< of inflow; 0 without a balance [rad]
    Induced quasi_steady = Induced::Zero();  ///< along the normal, and against the motion
    double induction = 0.0;                  ///< a
    Slope axial_slope = Slope::Zero(), tangential_slope = Slope::Zero();  ///< of `quasi_steady`
    Mat3 normal_slope, against_slope;  ///< of the unit vectors by a rotation of the section
  };
  /// What is left of W_qs in what a station feels in a step.
  struct Felt {
    Induced induced = Induced::Zero();
    double response = 0.0;                  ///< its derivative by W_qs
    std::optional<InflowTimes> times = {};  ///< by which it would follow, where no step passes
  };

  void add_blade(strip::StripLoad& blade, const model::NodeTable& nodes);
  RotorState motion(const model::State& state, const Stencil& stencil) const;
  // @param acting  share of the forces of the strip that acts
  Balanced balance(const Element& element, const strip::StationFlow& flow, const RotorState& rotor,
                   double near, double acting) const;
  InflowTimes times_of(const Element& element, const RotorState& rotor) const;
  Felt follow(std::size_t element, const Induced& quasi_steady, const RotorState& rotor,
              const Stencil& stencil);
  double share_of(const RotorState& rotor) const;
  bool turns_otherwise(const RotorState& rotor, const Vec3& hub_velocity) const;
  bool turns_across(const RotorState& rotor, const model::State& state,
                    const Stencil& stencil) const;
  double skew(const RotorState& rotor, const Element& element, const Vec3& outwards) const;

  const model::NodeTable& nodes_;
  RotorHub hub_;
  std::vector<strip::StripLoad*> blades_;
  RotorModel kind_;
  std::vector<Element> elements_;
  double tip_radius_ = 0.0;
  Vec3 lean_ = Vec3::Zero();  ///< mean of unit vectors along the blades, across the axis

  Memory accepted_, trial_;
  std::vector<strip::StationFlow> flows_;  ///< by element, of one evaluation
  std::vector<Balanced> balances_;         ///< likewise
  // what trial_ and the induced velocities belong to
  model::Coordinates evaluated_;  ///< empty: nothing
  double evaluated_time_ = 0.0;
  Stencil evaluated_stencil_;
};

}  // namespace culm::rotor
