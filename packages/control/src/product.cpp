#include <culm/control/product.hpp>

#include "fields.hpp"

#include <cmath>
#include <memory>
#include <vector>

namespace culm::control {

double Product::product(const Inputs& u) const {
  double product = gain_;
  for (Eigen::Index k = 0; k < u.size(); ++k) product *= std::pow(u[k], powers_[k]);
  return product;
}

void Product::evaluate(const Unknowns&, const Inputs& u, Values& values) const {
  const double whole = product(u);
  values.f[0] = output_.hold(whole);
  if (output_.slope(whole) == 0.0) return;
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    if (powers_[k] == 0.0) continue;
    Inputs others = u;
    others[k] = 1.0;  // so that a factor of zero has a derivative
    values.by_input(0, k) = product(others) * powers_[k] * std::pow(u[k], powers_[k] - 1.0);
  }
}

void register_product(SignalRegistry& registry) {
  Schema schema("Product", "A gain times signals, each to a power.");
  add_signals(schema);
  schema.add(numbers("Powers", "1", "A power for each; all 1 if absent. -1 divides.").optional())
      .add(number("Gain", "1", "Factor.").optional(1.0));
  add_limits(schema);
  add_scale(schema);
  schema.check([](const Options& options, InputIssues& issues) {
    if (options.has("Powers")) check_one_each(options, "Powers", issues);
  });
  registry.add("Product", schema, [](const Options& options, ControlContext& context) {
    const std::size_t count = options.texts("Signals").size();
    const std::vector<double> powers =
        options.has("Powers") ? options.numbers("Powers") : std::vector<double>(count, 1.0);
    context.add(options,
                std::make_unique<Product>(options.number("Gain"), as_inputs(powers),
                                          read_limits(options), options.number("Scale")),
                {"Signals"});
  });
}

}  // namespace culm::control
