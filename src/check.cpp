#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/simulation/input_files.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

#include <cstdlib>
#include <fstream>

namespace culm::app {
namespace {

// A file takes its place as a whole; what is none, such as /dev/stdout, is written to.
void write_resolved(const Options& deck, const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  const bool is_replaced = !std::filesystem::exists(target) || is_regular_file(target, error);
  const std::filesystem::path written = is_replaced ? target.string() + ".part" : path.string();
  std::ofstream file(written);
  file << deck::resolved(deck);
  file.close();
  if (file && is_replaced) std::filesystem::rename(written, target, error);
  if (file && !error) return;
  std::error_code ignored;
  if (is_replaced) std::filesystem::remove(written, ignored);
  throw FileError("cannot write '" + path.string() + "'");
}

// In a temporary folder one that is named after the deck, as folders of results are. Rank 0 makes
// it; collective.
std::filesystem::path make_model_folder(const parallel::Comm& comm,
                                        const std::filesystem::path& deck) {
  std::error_code failure;
  std::string name = (std::filesystem::temp_directory_path(failure) / "culm-XXXXXX").string();
  std::filesystem::path folder;
  if (comm.is_root() && !failure && mkdtemp(name.data()) != nullptr) {
    folder = std::filesystem::path(name) / deck.stem();
    std::filesystem::create_directory(folder, failure);
  }
  folder = comm.broadcast(failure ? std::string() : folder.string());
  if (folder.empty()) throw FileError(name, "cannot be made, which --view needs for a while");
  return folder;
}

}  // namespace

void check(const parallel::Comm& comm, CheckArguments& arguments) {
  const double memory = simulation::read_memory(arguments.memory, comm.most_on_a_machine());
  simulation::limit_memory(memory);
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const simulation::Catalogue catalogue;
  auto source = simulation::read_source(comm, arguments.deck, arguments.overrides);
  Options deck = simulation::read_deck(catalogue, source);
  for (const std::filesystem::path& written : {arguments.resolved, arguments.view}) {
    if (written.empty()) continue;
    simulation::refuse_overwriting(comm, simulation::find_input_files(deck, source), written);
  }
  if (!arguments.resolved.empty()) {
    simulation::refuse_other_files(deck, arguments.resolved.parent_path());
  }
  simulation::Simulation simulation(comm, catalogue, std::move(deck), std::move(source), log,
                                    memory);
  log.info(std::string(trim(simulation.summary())));
  if (!arguments.resolved.empty() && comm.is_root())
    write_resolved(simulation.deck(), arguments.resolved);
  if (!arguments.view.empty()) {
    const std::filesystem::path folder = make_model_folder(comm, arguments.deck);
    if (comm.is_root()) arguments.model = folder;
    simulation.write_model(folder / "run.h5");
  }
  simulation.examine();
  log.info("the deck is sound");
}

}  // namespace culm::app
