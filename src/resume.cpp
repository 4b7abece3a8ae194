#include <culm/simulation/resume.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

#include <unistd.h>

namespace culm::app {

void resume(const parallel::Comm& comm, const ResumeArguments& arguments) {
  const simulation::StopRequest request(simulation::find_walltime(arguments.walltime));
  const double memory = simulation::read_memory(arguments.memory);
  simulation::limit_memory(memory);
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const auto found = simulation::find_checkpoint(comm, arguments.run, log);
  const simulation::RunSettings settings{found.folder,
                                         arguments.quiet,
                                         comm.is_root() && isatty(STDOUT_FILENO) != 0,
                                         arguments.strict,
                                         {},
                                         {arguments.address, arguments.port, arguments.patience}};
  const simulation::Catalogue catalogue;
  auto source = arguments.deck.empty() ? simulation::DeckSource::restore(found.snapshot)
                                       : simulation::read_source(comm, arguments.deck, {});
  source.overrides.insert(source.overrides.end(), arguments.overrides.begin(),
                          arguments.overrides.end());
  const Options deck = simulation::read_deck(catalogue, source);
  simulation::check_resumed_deck(catalogue, deck, found.snapshot);
  simulation::warn_of_differences(comm, found.snapshot, log);
  log.info(simulation::describe(found, deck));
  simulation::Simulation(comm, catalogue, deck, source, log, memory)
      .run(settings, request, &found.snapshot);
}

}  // namespace culm::app
