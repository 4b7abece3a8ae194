#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/model/amplitude.hpp>

#include "time_formula.hpp"
#include "time_table.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

namespace culm::model {
namespace {

Schema with_intensity(const char* name, const char* doc, const char* unit = "1") {
  return Schema(name, doc).add(
      culm::number("Intensity", unit, "Factor on the whole function.").optional(1.0));
}

/// A type whose value is intensity x shape(time, span), where `span` is a duration of the deck.
/// @param corners  of the shape, over the span
using Shape = double (*)(double time, double span);
void add_shape(Registry<Amplitude>& registry, const char* name, const char* doc, Field span,
               Shape shape, std::vector<double> corners = {}) {
  const std::string parameter = span.name();
  registry.add(name, with_intensity(name, doc).add(std::move(span)),
               [parameter, shape, corners = std::move(corners)](const Options& options) {
                 const double a = options.number("Intensity");
                 const double t0 = options.number(parameter);
                 std::vector<double> times = corners;
                 for (double& time : times) time *= t0;
                 return Amplitude::of_time([=](double t) { return a * shape(t, t0); })
                     .with_corners(std::move(times));
               });
}

Field duration() { return number("Duration", "s", "Time that the function takes.").positive(); }

void add_shapes(Registry<Amplitude>& registry) {
  add_shape(registry, "Linear", "t / Duration without end (legacy: linear).", duration(),
            [](double t, double t0) { return t / t0; });
  add_shape(registry, "Linear Then Zero", "t / Duration, 0 after it (legacy: linear0).", duration(),
            [](double t, double t0) { return t <= t0 ? t / t0 : 0.0; }, {0.0, 1.0});
  add_shape(registry, "Linear Then Constant", "t / Duration, 1 after it (legacy: linearC).",
            duration(), [](double t, double t0) { return std::fmin(t / t0, 1.0); }, {1.0});
  add_shape(registry, "Triangle",
            "Up to 1 at half the Duration, down to 0 at its end (legacy: triangle).", duration(),
            [](double t, double t0) { return std::fmax(1.0 - std::abs(2.0 * t / t0 - 1.0), 0.0); },
            {0.0, 0.5, 1.0});
  add_shape(registry, "Square", "1 during the Duration, 0 after it (legacy: square).", duration(),
            [](double t, double t0) { return t <= t0 ? 1.0 : 0.0; }, {0.0, 1.0});
  add_shape(registry, "Heaviside", "0 before Start, 1 from there on (legacy: heaviside).",
            number("Start", "s", "Time of the jump."),
            [](double t, double t0) { return t < t0 ? 0.0 : 1.0; }, {1.0});
  add_shape(registry, "Sinusoidal", "sin(2 pi t / Period) (legacy: sinusoidal).",
            number("Period", "s", "Length of one cycle.").positive(),
            [](double t, double t0) { return std::sin(2.0 * std::numbers::pi * t / t0); });
}

void add_constant(Registry<Amplitude>& registry) {
  registry.add(
      "Constant", with_intensity("Constant", "The same at all times (legacy: constant)."),
      [](const Options& options) { return Amplitude::constant(options.number("Intensity")); });
}

void add_expression(Registry<Amplitude>& registry) {
  registry.add(
      "Expression",
      with_intensity("Expression", "A formula in the time t [s], such as t < 1 ? t^2 : 1.")
          .add(text("Expression", "Formula; may use variables of the deck.").formula_in("t"))
          .check([](const Options& options, InputIssues& issues) {
            const auto wrong = TimeFormula::mistake(options.text("Expression"));
            if (!wrong.empty()) issues.add(options.where("Expression"), wrong);
          }),
      [](const Options& options) {
        const double a = options.number("Intensity");
        const Where where = options.where("Expression");
        const TimeFormula formula(options.text("Expression"));
        return Amplitude::of_time([=](double t) {
          const double value = formula.value(t);
          if (std::isfinite(value)) return a * value;
          throw InputError(where, "must be finite at all times, is " + format_number(value) +
                                      " at t = " + format_number(t) + " s");
        });
      });
}

// 1 / dt in the one step with start <= t0 < end, so that the impulse does not depend on the step
void add_delta(Registry<Amplitude>& registry) {
  registry.add(
      "Delta",
      with_intensity("Delta", "An impulse, spread over the step that holds Time (legacy: delta).",
                     "s")
          .add(number("Time", "s", "Time of the impulse.")),
      [](const Options& options) {
        const double a = options.number("Intensity");
        const double t0 = options.number("Time");
        return Amplitude::of_step([=](double start, double end) {
                 return start <= t0 && t0 < end ? a / (end - start) : 0.0;
               })
            .with_corners({t0});
      });
}

// The mixing function of splitmix64 (Steele, Lea, Flood 2014), a bijection of 64-bit words.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

// The draw follows from seed and start of the step alone: the same on all ranks, in a repeated
// step and after a restart.
void add_random(Registry<Amplitude>& registry) {
  registry.add(
      "Random",
      with_intensity("Random", "Uniform between -1 and 1, one draw per step (legacy: random).")
          .add(integer("Seed", "Chooses the sequence.").optional(0)),
      [](const Options& options) {
        const double a = options.number("Intensity");
        const auto seed = static_cast<std::uint64_t>(options.integer("Seed"));
        return Amplitude::of_step([=](double start, double) {
          const std::uint64_t word = mix(mix(seed) ^ std::bit_cast<std::uint64_t>(start));
          return a * (std::ldexp(static_cast<double>(word >> 11U), -52) - 1.0);
        });
      });
}

Amplitude interpolation(const Options& options, TimeTable table) {
  const double a = options.number("Intensity");
  std::vector<double> corners = table.times;
  return Amplitude::of_time([a, table = std::move(table)](double t) { return a * table.value(t); })
      .with_corners(std::move(corners));
}

void add_tables(Registry<Amplitude>& registry) {
  registry.add(
      "Table",
      with_intensity("Table", "Linear between the given points, constant outside.")
          .add(numbers("Times", "s", "Times of the points, increasing.").min_size(1))
          .add(numbers("Values", "1", "Values at these times.").min_size(1))
          .check([](const Options& options, InputIssues& issues) {
            const auto wrong =
                TimeTable::mistake(options.numbers("Times"), options.numbers("Values"));
            if (!wrong.empty()) issues.add(options.where("Times"), wrong);
          }),
      [](const Options& options) {
        return interpolation(options, {options.numbers("Times"), options.numbers("Values")});
      });
  registry.add("File",
               with_intensity(
                   "File", "As Table, from a file with a time and a value per line (legacy: file).")
                   .add(text("File Name",
                             "Comma-separated file, relative to the deck; # starts a comment.")),
               [](const Options& options) {
                 return interpolation(options, read_time_table(options.text("File Name"),
                                                               options.where("File Name")));
               });
}

}  // namespace

void register_amplitudes(Registry<Amplitude>& registry) {
  add_constant(registry);
  add_shapes(registry);
  add_expression(registry);
  add_delta(registry);
  add_random(registry);
  add_tables(registry);
}

}  // namespace culm::model
