#include <culm/base/error.hpp>
#include <culm/simulation/replay.hpp>

#include "command.hpp"

namespace culm::app {

void replay(const parallel::Comm& comm, ReplayArguments& arguments) {
  if (arguments.deck.empty() == arguments.partner.empty()) {
    throw UsageError(
        "a replay needs either a deck, whose structure takes the loads of the record, or "
        "--partner, which is asked what the record says");
  }
  if (!arguments.partner.empty()) {
    const std::string found = simulation::replay_to_partner(comm, arguments.record,
                                                            arguments.partner, arguments.patience);
    Log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank()).info(found);
    return;
  }
  const simulation::Catalogue catalogue;
  const auto source = simulation::read_source(comm, arguments.deck, arguments.overrides);
  const std::vector<std::string> settings =
      simulation::replay_settings(comm, catalogue, source, arguments.record);
  arguments.overrides.insert(arguments.overrides.begin(), settings.begin(), settings.end());
  run(comm, arguments, arguments.record);
}

}  // namespace culm::app
