/// The equations of all blocks of a model.
#pragma once

#include <culm/control/block.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/model/model.hpp>

#include <memory>
#include <string>
#include <vector>

namespace culm::control {

/// Blocks with their unknowns, in the mid-point rule, whatever the scheme of the motion:
///   (x_next - x_prev) / h = f(x_mid, u_mid)     x_mid = (x_prev + x_next) / 2,
/// algebraic unknowns x = f(x_mid, u_mid), one value per step. In statics unknowns with a rate
/// stand still and the others follow them at the end of the step.
class BlockBatch final : public model::MemorylessBatch, public model::LimitedRange {
 public:
  /// @param model  gets the unknowns
  BlockBatch(model::Effect effect, model::Model& model)
      : MemorylessBatch(std::move(effect)), model_(model) {}

  /// @return the output
  model::Signal add(const std::string& name, std::unique_ptr<Block> block);
  /// Gives a block its inputs, by its output, up to Block::max_inputs. Where it is not told how to
  /// start, it starts at rest with the inputs of time 0, once settle() has found them.
  void connect(const model::Signal& output, std::vector<model::Amplitude> inputs,
               std::optional<double> initial);
  /// After all blocks are connected: finds what they start with, each from what its inputs start
  /// with, in whatever order they were added. In a circle without a block that is told how to
  /// start, as far as it was followed once round.
  void settle();

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  void prepare(const model::State& state, const Stencil& stencil) override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  model::StepWork step_work(const model::State&, const Stencil&) const override { return {}; }

  /// Steps over the longest one in which no block swings about what it follows: the mid-point rule
  /// takes a decay by r within a step h by the factor (2 - r h) / (2 + r h), which is negative with
  /// r h above 2.
  double range_used() const override;
  std::string range_warning(double used) const override;

 private:
  struct Item {
    std::unique_ptr<Block> block;
    std::vector<model::Signal> unknowns;
    std::vector<model::Amplitude> inputs;
    std::optional<double> initial;
  };
  /// Where in a step the equations of a block hold.
  static double place(const Stencil& stencil) { return stencil.step > 0.0 ? 0.5 : 1.0; }
  static Block::Unknowns start_of(const Item& item, const model::State& state);
  static void evaluate(const Item& item, const model::State& state, const Stencil& stencil,
                       Block::Values& values);
  [[noreturn]] void refuse(const Item& item, const model::State& state, double theta,
                           const char* what) const;
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;
  void add_inputs(std::size_t i, const Block::Values& values, double theta,
                  model::Target& target) const;

  model::Model& model_;
  std::vector<Item> items_;
  double trial_step_ = 0.0, step_ = 0.0;  // of the trial, and the last accepted one [s]
};

}  // namespace culm::control
