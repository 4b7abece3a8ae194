/// Controllers in shared objects as parts of a model.
#pragma once

#include <culm/control/swap_library.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/model/model.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace culm::control {

/// Libraries that are called in accepted states of a motion in time and nowhere else: at the end of
/// the first step and then whenever an interval has passed. What they demand is held until the next
/// call, so a trial never sees another state of them: one step late, and no part of the tangent.
/// Their own states can neither be copied nor put back: restore throws UsageError where calls were
/// made since, or are missing. A failure is thrown by prepare of the next step. In statics nothing
/// is called. Every process on which a library has unknowns calls a copy of its own.
class LibraryBatch final : public model::MemorylessBatch,
                           public model::LimitedRange,
                           public model::LeftOutOfModes {
 public:
  LibraryBatch(model::Effect effect, model::Model& model)
      : MemorylessBatch(std::move(effect)), model_(model) {}
  LibraryBatch(const LibraryBatch&) = delete;
  LibraryBatch& operator=(const LibraryBatch&) = delete;
  /// Libraries that were called get their last call.
  ~LibraryBatch() override;

  /// @param interval  least time between calls [s]; 0: every step
  void add(const std::string& name, std::unique_ptr<SwapLibrary> library, double interval);
  /// Whether there is a library of this name.
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;
  /// @return a signal that a library sets, once it is connected
  model::Signal add_output(const std::string& name, double initial);
  /// What a library sets, and reads at the end of a step. @pre has(library)
  void connect_output(const std::string& library, int record, const model::Signal& signal);
  void connect_input(const std::string& library, int record, model::Amplitude value);

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  void prepare(const model::State& state, const Stencil& stencil) override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  std::size_t memory_size() const override;
  void save(model::Items which, std::span<double> values) const override;
  void restore(std::span<const double> values) override;
  bool can_go_back() const override { return false; }
  model::StepWork step_work(const model::State&, const Stencil&) const override { return {}; }

  /// 2 once a library has warned or failed.
  double range_used() const override;
  std::string range_warning(double used) const override;
  std::string left_out_of_modes() const override;

 private:
  struct Output {
    int record = 0;
    model::Signal signal;
    double held = 0.0;
  };
  struct Input {
    int record = 0;
    model::Amplitude value;
  };
  struct Item {
    std::string name;
    std::unique_ptr<SwapLibrary> library;
    double interval = 0.0;
    std::vector<Output> outputs;
    std::vector<Input> inputs;
    double calls = 0.0;
    double last = 0.0;  ///< time of the last call [s]
    int warnings = 0;
    std::string warning;  ///< the first one, with its time
    std::string failure;
  };
  Item& find(const std::string& name);
  void call(Item& item, const model::State& state);

  model::Model& model_;
  std::vector<Item> items_;
  bool is_in_time_ = false;
};

}  // namespace culm::control
