/// Parameters that types of signals share.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/control/block.hpp>

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace culm::control {

inline Field input_field() { return text("Signal", "The signal or function that it follows."); }

/// Parameter "Signals".
inline void add_signals(Schema& schema) {
  schema.add(texts("Signals", "Names of up to eight signals or functions.").min_size(1))
      .check([](const Options& options, InputIssues& issues) {
        const std::size_t count = options.texts("Signals").size();
        if (count <= Block::max_inputs) return;
        issues.add(options.where("Signals"), "must be up to " + std::to_string(Block::max_inputs) +
                                                 ", got " + std::to_string(count));
      });
}

/// An issue where a parameter has not one number for each of "Signals".
inline void check_one_each(const Options& options, const std::string& parameter,
                           InputIssues& issues) {
  const std::size_t count = options.texts("Signals").size();
  const std::size_t found = options.numbers(parameter).size();
  if (count == found) return;
  issues.add(options.where(parameter), "must be as many as 'Signals', which are " +
                                           std::to_string(count) + "; got " +
                                           std::to_string(found));
}

/// One number per input. @pre up to Block::max_inputs
inline Block::Inputs as_inputs(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

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

/// Of an output whose limits hold its command: it starts between them.
inline void check_start(const Options& options, InputIssues& issues) {
  if (!options.has("Initial")) return;
  const double start = options.number("Initial");
  if (read_limits(options).hold(start) == start) return;
  issues.add(options.where("Initial"),
             fmt::format("must not be beyond 'Lower' or 'Upper', got {:g}", start));
}

/// Limits of command and rate, and the start.
inline void add_actuator_fields(Schema& schema) {
  add_limits(schema);
  schema.add(number("Rate Limit", "1/s", "Largest rate of change.").positive().optional());
  add_start(schema);
  schema.check(check_start);
}

inline Limits read_rate(const Options& options) {
  return options.has("Rate Limit") ? Limits::symmetric(options.number("Rate Limit")) : Limits();
}

}  // namespace culm::control
