#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

namespace culm::app {

void check(const parallel::Comm& comm, const DeckArguments& arguments) {
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const simulation::Catalogue catalogue;
  const Options deck = simulation::read_deck(comm, catalogue, arguments.deck, arguments.overrides);
  log.info(simulation::Simulation(comm, catalogue, deck, log).summary() + "the deck is sound");
}

}  // namespace culm::app
