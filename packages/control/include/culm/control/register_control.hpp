/// All types of the deck's list "Signals".
#pragma once

#include <culm/base/registry.hpp>
#include <culm/control/block_batch.hpp>
#include <culm/control/sample_batch.hpp>
#include <culm/model/build_context.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::control {

class LibraryBatch;
class SensorBatch;

/// Where signals are added to. They may follow each other in any order and in circles, so that all
/// of them are there before any gets its inputs.
class ControlContext {
 public:
  /// @param functions  gets the signals beside the functions that are there
  ControlContext(model::Model& model, std::map<std::string, model::Amplitude>& functions,
                 InputIssues& issues);
  ~ControlContext();

  /// Adds a block. @param inputs   parameters that name signals or functions, in the block's order
  /// @param initial  how it starts; nothing: at rest with its inputs
  void add(const Options& options, std::unique_ptr<Block> block, std::vector<std::string> inputs,
           std::optional<double> initial = {});
  /// The sensors of the model.
  SensorBatch& sensors() { return *sensors_; }
  /// Signals that keep a value for a step.
  SampleBatch& samples() { return *samples_; }
  /// Controllers in shared objects.
  LibraryBatch& libraries() { return *libraries_; }
  /// What is to be done once all signals are known, in the order of the calls.
  void when_complete(std::function<void()> task) { tasks_.push_back(std::move(task)); }
  /// Makes a signal known under the name of its entry.
  void publish(const Options& options, const model::Signal& signal);
  model::BuildContext& build() { return build_; }
  /// Gives all blocks their inputs, and the model what was added.
  void finish();

 private:
  struct Pending {
    const Options* options;
    model::Signal output;
    std::vector<std::string> inputs;
    std::optional<double> initial;
  };

  std::map<std::string, model::Amplitude>& functions_;
  model::BuildContext build_;
  std::unique_ptr<BlockBatch> blocks_;
  std::unique_ptr<SensorBatch> sensors_;
  std::unique_ptr<SampleBatch> samples_;
  std::unique_ptr<LibraryBatch> libraries_;
  std::vector<std::function<void()>> tasks_;
  std::vector<Pending> pending_;
};

using SignalRegistry = Registry<void, ControlContext&>;

void register_signals(SignalRegistry& registry);

}  // namespace culm::control
