#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

#include <unistd.h>

namespace culm::app {

void run(const parallel::Comm& comm, const DeckArguments& arguments) {
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const simulation::Catalogue catalogue;
  const Options deck = simulation::read_deck(comm, catalogue, arguments.deck, arguments.overrides);
  simulation::RunSettings settings;
  settings.folder = arguments.folder.empty() ? std::filesystem::path("results") /
                                                   std::filesystem::path(arguments.deck).stem()
                                             : arguments.folder;
  settings.quiet = arguments.quiet;
  settings.terminal = comm.is_root() && isatty(STDOUT_FILENO) != 0;
  simulation::Simulation(comm, catalogue, deck, log).run(settings);
}

}  // namespace culm::app
