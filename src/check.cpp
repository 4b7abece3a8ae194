#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/simulation/input_files.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

#include <fstream>

namespace culm::app {
namespace {

void write_resolved(const Options& deck, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << deck::resolved(deck);
  file.close();
  if (!file) throw FileError("cannot write '" + path.string() + "'");
}

}  // namespace

void check(const parallel::Comm& comm, const CheckArguments& arguments) {
  const double memory = simulation::find_memory(arguments.memory);
  simulation::limit_memory(memory);
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const simulation::Catalogue catalogue;
  const auto source = simulation::read_source(comm, arguments.deck, arguments.overrides);
  const Options deck = simulation::read_deck(catalogue, source);
  if (!arguments.resolved.empty()) {
    simulation::refuse_overwriting(comm, simulation::find_input_files(deck, source),
                                   arguments.resolved);
  }
  simulation::Simulation simulation(comm, catalogue, deck, source, log, memory);
  log.info(std::string(trim(simulation.summary())));
  if (!arguments.resolved.empty() && comm.is_root()) write_resolved(deck, arguments.resolved);
  simulation.examine();
  log.info("the deck is sound");
}

}  // namespace culm::app
