#include "sampled_signals.hpp"

#include <culm/base/absent.hpp>
#include <culm/base/nearest.hpp>

#include <algorithm>
#include <string>

namespace culm::simulation {
namespace {

constexpr const char* type = "History";

std::string block_name(const Options& entry) {
  return std::string(type) + " '" + entry.name() + "'";
}

}  // namespace

void register_sampled_signal(control::SignalRegistry& registry) {
  Schema schema(type,
                "A quantity that the history watches, as it is at the start of a step: one step "
                "late, whatever it is.");
  schema
      .add(text("Quantity",
                "Its column in history.csv without the unit, such as 'tip uz' of a Displacement "
                "'tip'."))
      .add(number("Initial", "1", "Value before it is known for the first time.").optional(0.0));
  registry.add(type, schema, [](const Options& options, control::ControlContext& context) {
    context.publish(options, context.samples().add(block_name(options), options.number("Initial")));
  });
}

std::vector<SampledSignal> find_sampled_signals(const Options& signals, const model::Model& model,
                                                const std::vector<WatchedQuantity>& watched,
                                                InputIssues& issues) {
  std::vector<SampledSignal> sampled;
  std::vector<std::string> names;
  for (const output::HistoryColumn& column : columns_of(watched)) names.push_back(column.name);
  for (const Options& entry : signals.entries()) {
    if (entry.text("Type") != type) continue;
    const auto& blocks = model.own_blocks();
    const auto block = std::ranges::find(blocks, block_name(entry), &model::OwnBlock::name);
    const auto column = std::ranges::find(names, entry.text("Quantity"));
    if (column == names.end()) {
      issues.add(entry.where("Quantity"), "the history has no column '" + entry.text("Quantity") +
                                              "'" + did_you_mean(entry.text("Quantity"), names));
      continue;
    }
    if (std::find(column + 1, names.end(), *column) != names.end()) {
      issues.add(entry.where("Quantity"), "the history has several columns '" + *column +
                                              "', in different units; rename one of them");
    }
    sampled.push_back({model.signal(static_cast<int>(block - blocks.begin()), 0),
                       static_cast<std::size_t>(column - names.begin())});
  }
  return sampled;
}

void sample(const std::vector<SampledSignal>& signals, const std::vector<WatchedQuantity>& watched,
            assembly::System& system, model::State& state) {
  system.synchronise(state);
  const std::vector<double> numbers = evaluate(watched, system, state);
  for (const SampledSignal& one : signals) {
    const double value = numbers[one.column];
    if (value == absent) continue;
    const auto at = static_cast<std::size_t>(one.signal.index);
    state.own[at] = state.own_prev[at] = value;
  }
}

}  // namespace culm::simulation
