#include <culm/base/error.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/simulation/stop_request.hpp>

#include "command.hpp"
#include "partner_program.hpp"

#include <unistd.h>

#include <optional>

namespace culm::app {
namespace {

// Where the deck waits for the program that is to be its partner.
std::string address_of_partner(const Options& deck) {
  std::string address;
  if (deck.has_list("Coupling")) {
    for (const Options& partner : deck.list("Coupling").list("Partners").entries()) {
      if (partner.text("Type") != "Socket") continue;
      if (!address.empty()) throw UsageError("--with starts one partner, and the deck has several");
      address = partner.text("Address");
    }
  }
  if (address.empty()) throw UsageError("--with needs a partner of type 'Socket'");
  return address;
}

}  // namespace

void run(const parallel::Comm& comm, RunArguments& arguments, const std::filesystem::path& replay,
         const simulation::ServeSettings& serve) {
  const simulation::StopRequest request(simulation::find_walltime(arguments.walltime));
  const double memory = simulation::read_memory(arguments.memory);
  simulation::limit_memory(memory);
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const std::filesystem::path by_name =
      std::filesystem::path("results") / std::filesystem::path(arguments.deck).stem();
  const simulation::RunSettings settings{arguments.folder.empty() ? by_name : arguments.folder,
                                         arguments.quiet,
                                         comm.is_root() && isatty(STDOUT_FILENO) != 0,
                                         arguments.strict,
                                         replay,
                                         serve};
  const simulation::Catalogue catalogue;
  const auto source = simulation::read_source(comm, arguments.deck, arguments.overrides);
  const Options deck = simulation::read_deck(catalogue, source);
  simulation::Simulation simulation(comm, catalogue, deck, source, log, memory);
  std::optional<PartnerProgram> partner;
  if (!arguments.partner_command.empty()) {
    const std::string address = address_of_partner(deck);
    if (comm.is_root()) partner.emplace(arguments.partner_command, address);
  }
  arguments.started = settings.folder;
  simulation.run(settings, request);
}

}  // namespace culm::app
