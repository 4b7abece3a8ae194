#include <culm/control/actuator.hpp>
#include <culm/control/external_signal.hpp>
#include <culm/control/extreme.hpp>
#include <culm/control/integral.hpp>
#include <culm/control/lag.hpp>
#include <culm/control/library.hpp>
#include <culm/control/library_batch.hpp>
#include <culm/control/pi_controller.hpp>
#include <culm/control/product.hpp>
#include <culm/control/register_control.hpp>
#include <culm/control/sensor.hpp>
#include <culm/control/table.hpp>
#include <culm/control/weighted_sum.hpp>

#include <utility>

namespace culm::control {

ControlContext::ControlContext(model::Model& model,
                               std::map<std::string, model::Amplitude>& functions,
                               InputIssues& issues)
    : functions_(functions),
      build_{model, functions, issues},
      blocks_(std::make_unique<BlockBatch>("Signals", model)),
      sensors_(std::make_unique<SensorBatch>("Sensors", model)),
      samples_(std::make_unique<SampleBatch>("Samples", model)),
      libraries_(std::make_unique<LibraryBatch>("Libraries", model)) {}

ControlContext::~ControlContext() = default;

void ControlContext::add(const Options& options, std::unique_ptr<Block> block,
                         std::vector<std::string> inputs, std::optional<double> initial) {
  const model::Signal output =
      blocks_->add(options.text("Type") + " '" + options.name() + "'", std::move(block));
  publish(options, output);
  pending_.push_back({&options, output, std::move(inputs), initial});
}

void ControlContext::publish(const Options& options, const model::Signal& signal) {
  const std::string& name = options.name();
  const bool is_new = functions_.emplace(name, model::Amplitude::of_signal(signal)).second;
  if (is_new && name != "Ramp" && name != "Constant") return;
  build_.issues.add(options.where(), "there is a function of this name");
}

void ControlContext::finish() {
  for (const auto& task : tasks_) task();
  for (const Pending& one : pending_) {
    const Options& options = *one.options;
    std::vector<model::Amplitude> inputs;
    bool is_complete = true;
    for (const std::string& parameter : one.inputs) {
      const std::vector<std::string> names =
          parameter == "Signals" ? options.texts(parameter) : std::vector{options.text(parameter)};
      for (const std::string& name : names) {
        auto input =
            model::find_function(name, options.where(parameter), build_, model::Follows::signals);
        is_complete = is_complete && input;
        if (input) inputs.push_back(*std::move(input));
      }
    }
    if (!is_complete) continue;
    blocks_->connect(one.output, std::move(inputs), one.initial);
  }
  model::Model& model = build_.model;
  if (libraries_->size() > 0) model.add_load(std::move(libraries_));
  if (samples_->size() > 0) model.add_load(std::move(samples_));
  if (sensors_->size() > 0) model.add_load(std::move(sensors_));
  if (blocks_->size() > 0) model.add_load(std::move(blocks_));
}

void register_signals(SignalRegistry& registry) {
  register_actuator(registry);
  register_external_signal(registry);
  register_extremes(registry);
  register_integral(registry);
  register_lag(registry);
  register_library(registry);
  register_pi_controller(registry);
  register_product(registry);
  register_sensors(registry);
  register_table(registry);
  register_weighted_sum(registry);
}

}  // namespace culm::control
