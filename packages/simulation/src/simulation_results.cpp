// The files that a simulation writes.

#include <culm/base/error.hpp>
#include <culm/base/version.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/output/folder_lock.hpp>
#include <culm/simulation/identity.hpp>
#include <culm/simulation/simulation.hpp>

#include "model_picture.hpp"
#include "on_root.hpp"
#include "simulation_parts.hpp"

#include <fmt/format.h>

#include <utility>

namespace culm::simulation {
namespace {

// On rank 0, which writes.
std::unique_ptr<output::FolderLock> take_folder(const parallel::Comm& comm,
                                                const std::filesystem::path& folder,
                                                const Log& log) {
  std::unique_ptr<output::FolderLock> lock;
  on_root(comm, [&] { lock = std::make_unique<output::FolderLock>(folder); });
  if (lock != nullptr && !lock->weakness().empty()) {
    log.warning(
        fmt::format("{}: cannot be locked ({}): nothing keeps another run from writing here",
                    folder.string(), lock->weakness()));
  }
  return lock;
}

// Who a run is; the same as before if it goes on.
output::RunInfo describe_run(const Options& deck, const model::Model& model,
                             const parallel::Comm& comm, const Snapshot* from) {
  output::RunInfo info{deck.text("Title"), std::string(version), deck::resolved(deck)};
  info.run = from == nullptr ? new_run_identity(comm) : from->text("run/id");
  info.deck = identity_of(deck);
  info.model = identity_of(model, deck);
  if (from != nullptr && from->text("run/model") != info.model) {
    throw FileError(
        "the checkpoint belongs to another model than the one that the deck makes: a table, a mesh "
        "or another file that it reads has changed");
  }
  return info;
}

std::vector<std::string> names_of(const std::vector<Options>& entries) {
  std::vector<std::string> names;
  for (const Options& entry : entries) names.push_back(entry.name());
  return names;
}

}  // namespace

std::unique_ptr<Simulation::Results> Simulation::open_results(const RunSettings& settings,
                                                              Checkpoints* checkpoints,
                                                              const Snapshot* from) {
  Parts& p = *parts_;
  const Options& output = p.deck.list("Output");
  const Phase& phase = p.phases.enter(p.present, p.comm, p.ledger);  // a new port took its system
  const ResultSettings wanted = {settings.folder,
                                 describe_run(p.deck, *p.phases.of(0).model, p.comm, from),
                                 names_of(p.deck.list("Analyses").entries()),
                                 output.integer("Every"),
                                 output.flag("Pictures"),
                                 static_cast<std::size_t>(output.integer("Most Pictures")),
                                 read_layer_settings(output.list("Shell"), *phase.model),
                                 output.flag("Velocities"),
                                 output.flag("Constraint Forces")};
  auto lock = take_folder(p.comm, settings.folder, p.log);
  return std::make_unique<Results>(p, settings, wanted, std::move(lock), checkpoints, from);
}

Simulation::Results::Results(Parts& p, const RunSettings& settings, const ResultSettings& wanted,
                             std::unique_ptr<output::FolderLock> taken, Checkpoints* checkpoints,
                             const Snapshot* from)
    : lock(std::move(taken)),
      files(*p.phases.of(p.present).system, *p.phases.of(0).model, wanted,
            p.phases.of(p.present).watched, from),
      observer(p.ledger, p.findings, files, checkpoints, p.source, p.earlier, p.imperfections,
               p.reference_turn, Progress(p.log, settings.quiet, settings.terminal)) {}

void Simulation::write_model(const std::filesystem::path& path) {
  Parts& p = *parts_;
  const Phase& phase = p.phases.enter(0, p.comm, p.ledger);
  const Options& first = p.deck.list("Analyses").entries().front();
  const double end = first.text("Type") == "Dynamic" ? first.number("End Time") : 1.0;
  draw_model(*phase.system, describe_run(p.deck, *phase.model, p.comm, nullptr), end, path);
}

}  // namespace culm::simulation
