/// Signals that take their values from quantities of the history.
#pragma once

#include <culm/control/register_control.hpp>
#include <culm/simulation/quantity.hpp>

#include <vector>

namespace culm::simulation {

/// A signal and the number of the quantities' columns that it is.
struct SampledSignal {
  model::Signal signal;
  std::size_t column = 0;
};

/// Signals / History
void register_sampled_signal(control::SignalRegistry& registry);

/// Those of a model, once the columns of all quantities are known; an issue where a signal names
/// none of them.
std::vector<SampledSignal> find_sampled_signals(const Options& signals, const model::Model& model,
                                                const std::vector<WatchedQuantity>& watched,
                                                InputIssues& issues);

/// Gives signals the present values of their quantities; those that do not exist leave them as they
/// are. Collective.
void sample(const std::vector<SampledSignal>& signals, const std::vector<WatchedQuantity>& watched,
            assembly::System& system, model::State& state);

}  // namespace culm::simulation
