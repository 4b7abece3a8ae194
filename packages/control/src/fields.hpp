/// Parameters that types of signals share.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/control/block.hpp>

#include <optional>

namespace culm::control {

inline Field input_field() { return text("Signal", "The signal or function that it follows."); }

inline void add_scale(Schema& schema) {
  schema.add(
      number("Scale", "1", "Size of the output where it is small: smaller errors do not count.")
          .positive()
          .optional(1.0));
}

inline void add_start(Schema& schema) {
  schema.add(
      number("Initial", "1", "Value at the start; at rest with its input if absent.").optional());
  add_scale(schema);
}

inline std::optional<double> read_start(const Options& options) {
  if (!options.has("Initial")) return {};
  return options.number("Initial");
}

inline void add_limits(Schema& schema) {
  schema.add(number("Lower", "1", "Least value.").optional())
      .add(number("Upper", "1", "Largest value.").optional())
      .check([](const Options& options, InputIssues& issues) {
        if (!options.has("Lower") || !options.has("Upper")) return;
        if (options.number("Lower") < options.number("Upper")) return;
        issues.add(options.where("Upper"), "must be above 'Lower'");
      });
}

inline Limits read_limits(const Options& options) {
  Limits limits;
  if (options.has("Lower")) limits.lower = options.number("Lower");
  if (options.has("Upper")) limits.upper = options.number("Upper");
  return limits;
}

/// Limits of command and rate, and the start.
inline void add_actuator_fields(Schema& schema) {
  add_limits(schema);
  schema.add(number("Rate Limit", "1/s", "Largest rate of change.").positive().optional());
  add_start(schema);
}

inline Limits read_rate(const Options& options) {
  return options.has("Rate Limit") ? Limits::symmetric(options.number("Rate Limit")) : Limits();
}

}  // namespace culm::control
