/// Loads of a flow on sections of slender structures.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/flow/flow.hpp>
#include <culm/flow/fluid_force.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/delayed.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/model/steady_rotation.hpp>
#include <culm/model/structure.hpp>
#include <culm/strip/airfoil.hpp>
#include <culm/strip/lag.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace culm::strip {

/// A section at a point of a line, which stands for a length of it.
struct Station {
  model::Marker point;         ///< on the axis of the line
  double length = 0.0;         ///< of the reference [m]
  double chord = 0.0;          ///< [m]
  double axis_at = 0.25;       ///< place of the axis behind the nose, in chords [-]
  Vec3 along = Vec3::Zero();   ///< unit vector from nose to tail, in the directors
  Vec3 across = Vec3::Zero();  ///< unit vector towards the suction side, in the directors
  SharedAirfoil airfoil = {}, next_airfoil = {};  ///< blended
  double blend = 0.0;                             ///< share of the second one
  double force_at = 0.25;  ///< where lift and drag act, by the direction of the wind there [chords]
  double angle_at = 0.75;  ///< where the wind has the angle and the speed that count [chords]

  /// Distance behind the axis of a place in chords from the nose [m].
  double behind(double place) const { return (place - axis_at) * chord; }

  /// In a steady flow. @param alpha  angle of attack from -pi to pi [rad]
  /// @param slope  derivatives by it [1/rad]
  Coefficients coefficients(double alpha, Coefficients& slope) const;
};

/// What a station saw and felt in a step.
struct StationState {
  double angle = 0.0;            ///< of attack at the three-quarter chord [rad]
  double effective_angle = 0.0;  ///< behind the lag [rad]
  double speed = 0.0;            ///< relative wind across the span [m/s]
  Coefficients coefficients = Coefficients::Zero();
  double normal = 0.0;      ///< force per length towards the suction side [N/m]
  double tangential = 0.0;  ///< and towards the tail [N/m]
  /// Attached share of the chord by the states of stall; one without them [-].
  double attached = 1.0;
  flow::FluidForce::Resultant resultant = {};                          ///< of the whole station
  double inflow_angle = 0.0, axial = 0.0, tangential_induction = 0.0;  ///< `InducedVelocity`

  static constexpr std::size_t size = 18;
  std::array<double, size> numbers() const;
  void set(std::span<const double> values);
};

/// Where a station is in a step, and what it meets there. @source fluids B2, B3
struct StationFlow {
  Vec3 place = Vec3::Zero();     ///< where the force acts, the quarter chord [m]
  Vec3 along = Vec3::Zero();     ///< unit vector from nose to tail
  Vec3 across = Vec3::Zero();    ///< unit vector towards the suction side
  Vec3 wind = Vec3::Zero();      ///< of the flow there, without induction [m/s]
  Vec3 velocity = Vec3::Zero();  ///< of the quarter chord; zero in statics [m/s]
  Vec3 turning = Vec3::Zero();   ///< by which that of the three-quarter chord differs [m/s]
  /// What the structure feels [m/s].
  Vec3 relative() const { return wind - velocity; }
};

/// What others induce at a station.
struct InducedVelocity {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  /// Its derivative by the motion of the station (`StationFlow`): columns by `velocity`, by
  /// `turning`, and by a small rotation of `along` and `across` about fixed axes [m/s].
  Mat<3, 9> slope = Mat<3, 9>::Zero();
  /// In statics and linearisations, the part of the derivative that follows with two lags side by
  /// side of the times [s] and with the shares; there is none without a `slow_time`.
  Mat<3, 9> following = Mat<3, 9>::Zero();
  double slow_time = 0.0, fast_time = 0.0;
  double slow_share = 0.0;  ///< the other one has the rest [-]
  /// For those who look at it: between the wind with all that is induced and the plane of rotation
  /// [rad], and by how much the wind through it is slower, and that against the motion faster [-].
  double inflow_angle = 0.0, axial = 0.0, tangential = 0.0;
};

/// Induces velocities at stations of strips, such as a rotor.
class Inducer {
 public:
  virtual ~Inducer() = default;
  /// Sets what it induces (`StripLoad::set_induced`) for the motion that is tried, on all ranks and
  /// for all of its strips; before each evaluation of any of them.
  virtual void induce(const model::State& state, const Stencil& stencil) = 0;
};

/// How the lift follows when the flow leaves the section and comes back.
enum class Stall {
  none,         ///< at once
  oye,          ///< one state per airfoil, the attached share of the chord
  four_states,  ///< two of the lag, and of each airfoil the pressure and the attached share
};

/// Which effects the loads have.
struct StripModel {
  Lag lag;
  bool apparent_mass = false;
  Stall stall = Stall::none;
};

/// What a station carries from step to step; of two airfoils where it stands between two.
struct SectionStates {
  static constexpr std::size_t size = Lag::max_states + 4;
  std::array<double, Lag::max_states> lag{};
  std::array<double, 2> attached = {1.0, 1.0};  ///< shares of the chord, at first all of it
  std::array<double, 2> pressure = {0.0, 0.0};  ///< lift that the attached flow has built up

  /// All of them, with room for each.
  std::array<double, size> numbers() const {
    return {lag[0], lag[1], attached[0], attached[1], pressure[0], pressure[1]};
  }
  void set(std::span<const double> values) {
    lag = {values[0], values[1]};
    attached = {values[2], values[3]};
    pressure = {values[4], values[5]};
  }
};

/// Kinds of states of a section: those of the lag move the pressure, this the attached share. Both
/// airfoils of a section have the same times. What is induced follows with two.
namespace state_kind {
constexpr std::size_t first_lag = 0;  ///< and those of the lag after it
constexpr std::size_t pressure = Lag::max_states;
constexpr std::size_t attached = pressure + 1;
constexpr std::size_t slow_inflow = attached + 1;
constexpr std::size_t fast_inflow = slow_inflow + 1;
constexpr std::size_t count = fast_inflow + 1;
}  // namespace state_kind
/// A number of each kind of states.
using PerStateKind = std::array<double, state_kind::count>;

/// Lift, drag and moment of sections by their coefficients, at the angle of the three-quarter
/// chord, with the lag of the circulation and apparent mass. Points of a section are linear in the
/// coordinates, x + eta c with the axis x and the unit vector c along the chord; forces come in by
/// the transpose of the same map, so that their work over a step is F . Dx of their points. The
/// wind is that without the structure, and what others induce. In statics the structure stands
/// still, and lags have ended. States of the lag start at zero, as after a sudden start from rest,
/// unless a static analysis was before; those of stall with a flow that is attached. A
/// linearisation has all of these states as single lags side by side: what passes several lags one
/// after another, product_i 1 / (1 + s T_i), is sum_i c_i / (1 + s T_i) with c_i = product_j T_i /
/// (T_i - T_j). @source fluids B0, B2, B4
class StripLoad final : public model::MemorylessBatch,
                        public model::LimitedRange,
                        public model::Delayed,
                        public flow::FluidForce {
 public:
  static constexpr int max_nodes = 4;

  StripLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
            flow::SharedFlow flow, StripModel model)
      : MemorylessBatch(std::move(effect)),
        FluidForce(*flow),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        flow_(std::move(flow)),
        model_(model) {}

  void add(Station station);

  const std::vector<Station>& stations() const { return stations_; }
  /// The share of the air that acts, by time.
  const model::Amplitude& amplitude() const { return amplitude_; }
  /// Of a station of this rank in the last accepted step; nothing before the first one, on all
  /// ranks alike.
  std::optional<StationState> state(int station) const {
    if (!has_stepped_) return {};
    return accepted_[static_cast<std::size_t>(station)].seen;
  }
  /// The flow that a station meets in the step from state.prev to state.next, before anything is
  /// induced; of any station of the model, if all ranks know all nodes.
  StationFlow flow_at(int station, const model::State& state, const Stencil& stencil) const;
  /// When a step, or statics, sees the flow [s].
  double time_of_flow(const model::State& state, const Stencil& stencil) const;
  const flow::Flow& flow() const { return *flow_; }
  const StripModel& kind() const { return model_; }
  /// Sets what others induce at a station, such as a rotor: it adds to the wind of both of its
  /// points until it is set anew; the tangent knows its slope. Zero at first. Whoever sets it does
  /// so on all ranks, and keeps what it needs of accepted states.
  void set_induced(int station, const InducedVelocity& induced) {
    induced_[static_cast<std::size_t>(station)] = induced;
    kept_[static_cast<std::size_t>(station)] = {};
  }
  /// Describes the stations in a frame that turns with them, whose velocity is theirs, too. All of
  /// it turns, and the wind has to look the same from all sides: an InputError at `where` names a
  /// station that does not find it so.
  void stand_in(const model::SteadyRotation& frame, Where where);
  /// Null: they stand in space.
  const model::SteadyRotation* frame() const { return frame_; }
  /// Asks somebody before each evaluation; null at first: nobody.
  void set_inducer(Inducer* inducer) { inducer_ = inducer; }
  const Inducer* inducer() const { return inducer_; }
  const InducedVelocity& induced(int station) const {
    return induced_[static_cast<std::size_t>(station)];
  }
  /// Whether this rank counts a station in sums.
  bool owns(int station) const { return owned_[static_cast<std::size_t>(station)]; }

  int size() const override { return static_cast<int>(stations_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  void place(model::Placement placement, model::Form form) override;
  void prepare(const model::State& state, const Stencil& stencil) override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  /// Velocities are those in the middle of the step, which other schemes do not know.
  bool needs_mean_velocity() const override { return true; }
  std::optional<Resultant> resultant() const override;
  double range_used() const override;
  std::string range_warning(double used) const override;
  std::vector<double> delays(const model::State& state) const override;
  Verdict assemble_delayed(const model::State& state, const Stencil& stencil, double delay,
                           model::Target& target) override;
  std::size_t memory_size() const override;
  void save(model::Items items, std::span<double> numbers) const override;
  void restore(std::span<const double> numbers) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  /// A station at the end of a step.
  struct StationEnd {
    SectionStates memory;
    StationState seen;
  };
  struct Evaluation;
  /// Forces of the last evaluation of a station, and what they belong to: the work of a step asks
  /// for them once more.
  struct Kept {
    Mat3 vectors = Mat3::Zero();     ///< axis, chord and normal at the end of the step
    double time = 0.0, step = -1.0;  ///< a negative step: of nothing
    Mat3 forces = Mat3::Zero();      ///< on them [N]
  };
  void keep_forces(std::size_t station, const model::State& state, const Stencil& stencil,
                   const Mat3& forces);
  /// Null if there are none for this motion.
  const Mat3* kept_forces(std::size_t station, const model::State& state,
                          const Stencil& stencil) const;
  /// Throws InputError unless the wind at a station turns with the frame.
  void refuse_wind_across_frame(std::size_t station, const model::State& state,
                                const Stencil& stencil) const;
  static constexpr PerStateKind all_follow = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  /// @param follow  what share of a change of their targets states follow, where there are no steps
  template <class Number>
  Evaluation evaluate(std::size_t station, const model::State& state, const Stencil& stencil,
                      Want want, const PerStateKind& follow = all_follow) const;
  /// Times of the states of a station about a steady state, no two alike; infinite where it has
  /// none [s].
  PerStateKind times_of(std::size_t station, const model::State& state) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil, Want want,
                        model::Target& target);
  template <class Space>
  void add_tangent(std::size_t i, const Evaluation& found, const model::State& state, double theta,
                   bool turns, model::Target& target);

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  flow::SharedFlow flow_;
  StripModel model_;
  std::vector<Station> stations_;
  std::vector<bool> owned_;
  std::vector<InducedVelocity> induced_;
  Inducer* inducer_ = nullptr;
  const model::SteadyRotation* frame_ = nullptr;
  Where frame_where_;
  std::vector<StationEnd> accepted_, trial_;
  std::vector<Kept> kept_;
  bool has_stepped_ = false;
};

}  // namespace culm::strip
