#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/simulation/couple.hpp>

#include "command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::app {
namespace {

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
      report.gap(), report.exchanged > 0.0 ? std::abs(report.gap()) / report.exchanged : 0.0);
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
  const std::string port = arguments.port.empty() && simulation.port_names().size() == 1
                               ? simulation.port_names().front()
                               : arguments.port;
  analysis::Stepper& stepper = simulation.begin(arguments.analysis);
  log.info(words(port, simulation::couple(simulation, stepper, port, *partner, *scheme,
                                          {arguments.tolerance, arguments.most})));
  stepper.finish();
}

}  // namespace culm::app
