/// Constraints that stay equations: multipliers and rows in the matrix.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/constraint.hpp>
#include <culm/model/held_point.hpp>
#include <culm/model/projection.hpp>

namespace culm::model {

/// Enforces h(q_next) = 0 with the forces H(q_theta)^T lambda, which do no work because h is
/// quadratic. @source formulation 4.1, 4.2
class ConstraintBatch final : public Batch {
 public:
  /// Largest constraint: nodes and rows.
  static constexpr int max_nodes = 8;
  static constexpr int max_rows = 12;

  /// @param length length of the model [m], the measure for rows that hold positions
  ConstraintBatch(Effect effect, const NodeTable& nodes, double length)
      : effect_(std::move(effect)), nodes_(nodes), length_(length) {}

  /// @param constraint  which must live as long @param number  of it in the UnknownTable
  void add(const Constraint& constraint, int number);

  const Effect& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(items_.size()); }
  bool has_tangent() const override { return true; }
  std::vector<int> blocks(int item, const UnknownTable& unknowns) const override;
  void place(Placement placement, Form form) override;
  void prepare(const State& state, const Stencil& stencil) override;
  Verdict assemble(const State& state, const Stencil& stencil, Want want, Target& target) override;
  void extrapolate(const State&, const Stencil&, const Coordinates&) override {}  // no stress
  double stored_energy(const Coordinates&) const override { return 0.0; }
  StepWork step_work(const State& state, const Stencil& stencil) const override;

  /// Where the multipliers of each item start in State::multipliers. Set with the numbering.
  void number(const UnknownTable& unknowns);

  /// Force [N] and moment about the node [N m] by which the constraints act on a node,
  /// -P^T H^T lambda at the end of the step.
  /// @param constraint name of the only one to count; all if empty
  Vec6 reaction(int node, const State& state, const std::string& constraint = {}) const;

 private:
  struct Item {
    const Constraint* constraint = nullptr;
    int number = 0;
    int first_multiplier = 0;
    std::vector<double> measure;  ///< what |h| is judged against, per row
    /// Rows that move, as they act on forces and as they must hold at the end of the step; empty
    /// where none do.
    std::vector<ConstraintRow> moved_mid, moved_next;
    /// Derivatives of both by the signal that is followed; empty without one.
    std::vector<ConstraintRow> slopes_mid, slopes_next;

    const std::vector<ConstraintRow>& rows_mid() const {
      return constraint->is_driven() ? moved_mid : constraint->rows;
    }
    const std::vector<ConstraintRow>& rows_next() const {
      return constraint->is_driven() ? moved_next : constraint->rows;
    }
  };

  template <class Space>
  Verdict assemble_item(std::size_t i, const State& state, const Stencil& stencil, Want want,
                        Target& target) const;
  template <class Space, class Jacobian>
  void add_border(std::size_t i, const Jacobian& columns, const Jacobian& rows,
                  Target& target) const;
  template <class Space, class Motion, class Jacobian>
  void add_curvature(std::size_t i, const Motion& motion, const Jacobian& H_mid,
                     const double* lambda, double theta, Target& target) const;
  void follow_signals(const State& state, const Stencil& stencil);
  template <class Space, class Motion>
  void add_signal(std::size_t i, const Motion& motion, const double* lambda, double theta,
                  Target& target) const;
  template <class Space>
  void assemble_jacobian(std::size_t i, const State& state, Target& target) const;

  Effect effect_;
  const NodeTable& nodes_;
  double length_;
  std::vector<Item> items_;
  std::vector<std::size_t> driven_;  ///< items whose rows move with time
  Placement placement_;
  std::vector<std::size_t> followers_;  ///< items that are placed here and follow a signal
  /// Items that are placed here and hold a point, by their places, which rise.
  std::vector<std::pair<std::size_t, HeldPoint>> points_;
  Form form_ = Form::null_space;
};

}  // namespace culm::model
