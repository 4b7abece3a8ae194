// A deck: XML, schema, expressions, units, and the model that it builds.

#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/simulation.hpp>

#include "fuzz_target.hpp"

#include <sstream>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static const culm::simulation::Session session(*argc, *argv);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace culm;
  static const simulation::Catalogue catalogue;
  fuzz::survive([&] {
    const std::string name = (fuzz::scratch_folder() / "deck.xml").string();
    const simulation::DeckSource source{{{name, std::string(fuzz::text_of(data, size))}}, {}};
    const Options deck = simulation::read_deck(catalogue, source);
    std::ostringstream messages;
    const Log log(messages, LogLevel::info);
    (void)simulation::Simulation(parallel::Comm(), catalogue, deck, source, log).summary();
  });
  return 0;
}
