#include <culm/simulation/resume.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"
#include "partner_program.hpp"

#include <memory>
#include <utility>

namespace culm::app {

void resume(const parallel::Comm& comm, ResumeArguments& arguments) {
  const simulation::StopRequest request(simulation::find_walltime(arguments.walltime));
  const double memory = simulation::read_memory(arguments.memory, comm.most_on_a_machine());
  simulation::limit_memory(memory);
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const auto found = simulation::find_checkpoint(comm, arguments.run, log);
  const simulation::RunSettings settings{found.folder,
                                         arguments.quiet,
                                         comm.is_root() && is_on_terminal(arguments),
                                         arguments.strict,
                                         {},
                                         {arguments.address, arguments.port, arguments.patience}};
  const simulation::Catalogue catalogue;
  auto source = arguments.deck.empty() ? simulation::DeckSource::restore(found.snapshot)
                                       : simulation::read_source(comm, arguments.deck, {});
  source.overrides.insert(source.overrides.end(), arguments.overrides.begin(),
                          arguments.overrides.end());
  Options deck = simulation::read_deck(catalogue, source);
  simulation::check_resumed_deck(catalogue, deck, found.snapshot);
  arguments.needs_launcher = needs_launcher(deck, arguments);
  if (arguments.needs_launcher) return;
  simulation::warn_of_differences(comm, found.snapshot, log);
  log.info(simulation::describe(found, deck));
  simulation::Simulation simulation(comm, catalogue, std::move(deck), std::move(source), log,
                                    memory);
  const std::unique_ptr<PartnerProgram> partner = start_partner(comm, simulation.deck(), arguments);
  arguments.started = found.folder;
  simulation.run(settings, request, &found.snapshot);
}

}  // namespace culm::app
