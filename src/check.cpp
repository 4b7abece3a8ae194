#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

namespace culm::app {

void check(const parallel::Comm& comm, const DeckArguments& arguments) {
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const simulation::Catalogue catalogue;
  const auto source = simulation::read_source(comm, arguments.deck, arguments.overrides);
  const Options deck = simulation::read_deck(catalogue, source);
  log.info(simulation::Simulation(comm, catalogue, deck, source, log).summary() +
           "the deck is sound");
}

}  // namespace culm::app
