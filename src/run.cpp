#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/simulation/stop_request.hpp>

#include "command.hpp"
#include "partner_program.hpp"

#include <memory>
#include <utility>

namespace culm::app {

void run(const parallel::Comm& comm, RunArguments& arguments, const std::filesystem::path& replay,
         const simulation::ServeSettings& serve) {
  const simulation::StopRequest request(simulation::find_walltime(arguments.walltime));
  const double memory = simulation::read_memory(arguments.memory, comm.most_on_a_machine());
  simulation::limit_memory(memory);
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const std::filesystem::path by_name =
      std::filesystem::path("results") / std::filesystem::path(arguments.deck).stem();
  const simulation::RunSettings settings{arguments.folder.empty() ? by_name : arguments.folder,
                                         arguments.quiet,
                                         comm.is_root() && is_on_terminal(arguments),
                                         arguments.strict,
                                         replay,
                                         serve};
  const simulation::Catalogue catalogue;
  auto source = simulation::read_source(comm, arguments.deck, arguments.overrides);
  Options deck = simulation::read_deck(catalogue, source);
  arguments.needs_launcher = needs_launcher(deck, arguments);
  if (arguments.needs_launcher) return;
  simulation::Simulation simulation(comm, catalogue, std::move(deck), std::move(source), log,
                                    memory);
  const std::unique_ptr<PartnerProgram> partner = start_partner(comm, simulation.deck(), arguments);
  arguments.started = settings.folder;
  simulation.run(settings, request);
}

}  // namespace culm::app
