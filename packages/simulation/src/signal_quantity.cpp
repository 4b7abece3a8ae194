#include <culm/simulation/quantity.hpp>

#include <memory>

namespace culm::simulation {
namespace {

class SignalQuantity final : public Quantity {
 public:
  explicit SignalQuantity(const model::Signal& signal) : signal_(signal) {}

  std::vector<output::HistoryColumn> columns() const override { return {{"", "1"}}; }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    numbers.push_back(signal_.in_step(state, 1.0));
  }

 private:
  model::Signal signal_;
};

}  // namespace

void register_signal_quantity(QuantityRegistry& registry) {
  Schema schema(
      "Signal",
      "Value of a signal: at the end of the step of what has a rate, else in its middle.");
  schema.add(text("Signal", "Its name."));
  registry.add(
      "Signal", schema,
      [](const Options& options, model::BuildContext& context) -> std::unique_ptr<Quantity> {
        const auto found =
            model::find_function(options, context, "Signal", model::Follows::signals);
        if (!found) return nullptr;
        if (found->signal() != nullptr) {
          return std::make_unique<SignalQuantity>(*found->signal());
        }
        context.issues.add(options.where("Signal"), "'" + options.text("Signal") +
                                                        "' is a function of time and no "
                                                        "signal");
        return nullptr;
      });
}

}  // namespace culm::simulation
