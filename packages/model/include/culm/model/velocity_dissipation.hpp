/// Numerical dissipation of velocities that leaves rigid motions alone.
#pragma once

#include <culm/model/model.hpp>

#include <vector>

namespace culm::model {

/// Replaces Dq/h = v_mean by Dq/h = v_mean + 1/2 chi (1 - Pi) Dv on bodies: sets of nodes coupled
/// through mass. Pi projects onto rigid velocities and rigid accelerations, e_i, e_i x q_mean and
/// e_i x v_mean, orthogonally in the metric of the mass, so momenta are kept, steady spin is not
/// braked, and 1/2 chi |(1 - Pi) Dv|^2 is taken from the energy per step. Slots without mass keep
/// the mean velocity.
///
/// As a batch it adds what the accelerations of the other batches lack, from the plain change of
/// velocity s = 2 Dq/h - 2 v_prev and with Dv = s - chi/(1 + chi) (1 - Pi) s. The tangent is left
/// as it is: exact for rigid motions, and deformations converge by chi/(1 + chi) per iteration at
/// worst. Needs all nodes up to date on every rank. @source formulation 4.7, variant R
class VelocityDissipation final : public Batch {
 public:
  /// That of a model, added when it is first asked for.
  static VelocityDissipation& of(Model& model);

  explicit VelocityDissipation(const Model& model) : model_(model) {}

  /// @param chi in (0, 1]
  void add_body(std::vector<int> nodes, double chi);

  const Effect& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const UnknownTable& unknowns) const override;
  bool has_tangent() const override { return false; }
  void place(Placement placement, Form form) override;
  void prepare(const State& state, const Stencil& stencil) override;
  /// Makes of the plain velocity 2 Dq/h - v_prev that of the damped relation.
  void accept(State& state) override;
  bool needs_mean_velocity() const override { return true; }
  bool needs_all_nodes() const override { return true; }
  Verdict assemble(const State& state, const Stencil& stencil, Want want, Target& target) override;
  void extrapolate(const State&, const Stencil&, const Coordinates&) override {}  // no stress
  double stored_energy(const Coordinates&) const override { return 0.0; }
  StepWork step_work(const State& state, const Stencil& stencil) const override;

 private:
  /// Columns of Z, or of M Z, over the coordinates of a body.
  using Basis = Eigen::Matrix<double, Eigen::Dynamic, 9>;
  /// A vector over the coordinates of a body, and its product with the mass.
  struct Pair {
    Eigen::VectorXd x, mx;
  };
  struct Body {
    std::vector<int> nodes;
    double chi = 0.0;
    bool counted = false;  ///< by this rank, in sums such as the energy taken
    double mass = 0.0;
    Eigen::VectorXd position_mass;  ///< mass between a slot and all positions, by slot
    Pair velocity;                  ///< at the start of the step
    Pair mean;                      ///< configuration
    Pair plain;                     ///< s
    Pair damped;                    ///< (1 - Pi) s
    Pair moving;                    ///< mean velocity
    Eigen::VectorXd last;           ///< damped.x one iteration ago
    Basis z, mz;  ///< orthonormal in the metric of the mass; zero where columns depend on others
  };

  void collect_masses();
  void take(const Coordinates& values, Pair Body::*pair);
  void project_all(const State& state, double h);
  void project(Body& body);
  static void centre(const Body& body, Pair& pair);
  static void set_turns(Body& body, int first, const Pair& pair);
  static void orthonormalise(Body& body, int first, int last);

  Effect effect_{"Velocity dissipation"};
  const Model& model_;
  std::vector<const MassSource*> masses_;
  std::vector<Body> bodies_;
  std::vector<std::pair<int, int>> items_;  ///< (body, which of its nodes)
  Placement placement_;
  Form form_ = Form::null_space;
  double step_ = 0.0;           ///< length of the step [s]; 0 without inertia
  std::vector<bool> has_mass_;  ///< by slot
  Coordinates values_, product_;
};

}  // namespace culm::model
