#include <culm/base/error.hpp>
#include <culm/base/findings.hpp>
#include <culm/base/nearest.hpp>
#include <culm/simulation/couple.hpp>

#include "command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::app {
namespace {

// Share of what was exchanged that the interface may make or lose.
constexpr double notable_gap = 1e-3;

double relative_gap(const simulation::CouplingReport& report) {
  return report.exchanged > 0.0 ? std::abs(report.gap()) / report.exchanged : 0.0;
}

std::string words(const std::string& port, const simulation::CouplingReport& report) {
  return fmt::format(
      "{} steps, {:.1f} attempts per step, at most {}\n"
      "interface '{}' over {} steps\n"
      "  work on the structure             {:>20.12g} J\n"
      "  energy that the partner gained    {:>20.12g} J\n"
      "  energy that it turned into heat   {:>20.12g} J\n"
      "  gap                               {:>20.2g} J, {:.1e} of all that was exchanged",
      report.windows, static_cast<double>(report.attempts) / std::max(report.windows, 1),
      report.most_attempts, port, report.windows, report.work, report.energy, report.dissipated,
      report.gap(), relative_gap(report));
}

// Why the energy at the interface cannot be trusted; empty if it can.
std::string describe_gap(const simulation::CouplingReport& report) {
  const double gap = relative_gap(report);
  if (gap <= notable_gap) return {};
  return fmt::format(
      "the interface {} {:.2g} % of the energy that is exchanged: results are those of a coupling "
      "that is too loose; take another --scheme than explicit, or a smaller --tolerance",
      report.gap() < 0.0 ? "loses" : "makes", 100.0 * gap);
}

// The port that is asked for, or the only one.
std::string find_port(const simulation::Simulation& simulation, const std::string& asked) {
  if (!asked.empty()) return asked;
  const std::vector<std::string> names = simulation.port_names();
  if (names.size() == 1) return names.front();
  throw UsageError(names.empty()
                       ? "the deck has no port"
                       : "the deck has " + std::to_string(names.size()) +
                             " ports; --port says which, such as '" + names.front() + "'");
}

}  // namespace

void couple(const parallel::Comm& comm, const CoupleArguments& arguments) {
  const double memory = simulation::find_memory(arguments.memory);
  simulation::limit_memory(memory);
  const auto partner = coupling::find_partner(arguments.partner, arguments.numbers);
  if (partner == nullptr) {
    throw UsageError("there is no partner '" + arguments.partner + "'" +
                     did_you_mean(arguments.partner, coupling::partner_names()));
  }
  const auto scheme = coupling::find_scheme(arguments.scheme, arguments.relaxation);
  if (scheme == nullptr) {
    throw UsageError("there is no scheme '" + arguments.scheme + "'" +
                     did_you_mean(arguments.scheme, coupling::scheme_names()));
  }
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  auto simulation = simulation::Simulation::open(arguments.deck, arguments.overrides, log, comm);
  const std::string port = find_port(simulation, arguments.port);
  analysis::Stepper& stepper = simulation.begin(arguments.analysis);
  const simulation::CouplingReport report = simulation::couple(
      simulation, stepper, port, *partner, *scheme, {arguments.tolerance, arguments.most});
  log.info(words(port, report));
  stepper.finish();
  std::string broken = simulation.broken_promises();
  if (const std::string gap = describe_gap(report); !gap.empty()) {
    broken += (broken.empty() ? "" : "\n") + gap;
  }
  if (!broken.empty()) throw PromiseBroken(broken);
}

}  // namespace culm::app
