#include <culm/control/library_batch.hpp>
#include <culm/control/register_control.hpp>
#include <culm/control/sensor.hpp>

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
  blocks_->settle();
  model::Model& model = build_.model;
  if (libraries_->size() > 0) model.add_load(std::move(libraries_));
  if (samples_->size() > 0) model.add_load(std::move(samples_));
  if (sensors_->size() > 0) model.add_load(std::move(sensors_));
  if (blocks_->size() > 0) model.add_load(std::move(blocks_));
}

// Every type, one line each: NAME stands for register_NAME.
#define CULM_SIGNALS(TYPE) \
  TYPE(actuator)           \
  TYPE(external_signal)    \
  TYPE(extremes)           \
  TYPE(integral)           \
  TYPE(lag)                \
  TYPE(library)            \
  TYPE(pi_controller)      \
  TYPE(product)            \
  TYPE(sensors)            \
  TYPE(table)              \
  TYPE(weighted_sum)

#define CULM_DECLARE(type) void register_##type(SignalRegistry& registry);
CULM_SIGNALS(CULM_DECLARE)
#undef CULM_DECLARE

void register_signals(SignalRegistry& registry) {
#define CULM_REGISTER(type) register_##type(registry);
  CULM_SIGNALS(CULM_REGISTER)
#undef CULM_REGISTER
}

}  // namespace culm::control
