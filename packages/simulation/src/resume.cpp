#include <culm/base/error.hpp>
#include <culm/base/version.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/simulation/deck_changes.hpp>
#include <culm/simulation/identity.hpp>
#include <culm/simulation/resume.hpp>

#include "checkpoints.hpp"
#include "on_root.hpp"
#include "run_observer.hpp"

#include <fmt/core.h>

namespace culm::simulation {

std::string read_sound_checkpoint(const std::filesystem::path& file) {
  std::string content = output::read_checkpoint(file);
  try {
    if (Snapshot::decode(content).integer("format") == RunObserver::checkpoint_format) {
      return content;
    }
  } catch (const FileError& error) {
    throw FileError(file.string(), error.what());
  }
  throw FileError(file.string(), "was written by a version of culm that is not compatible");
}

namespace {

struct Content {
  std::filesystem::path file;
  std::string bytes;
  std::string warning;
};

Content read_newest(const std::filesystem::path& folder) {
  const std::filesystem::path newest = checkpoint_path(folder);
  const std::filesystem::path older = output::previous_checkpoint(newest);
  std::error_code ignored;
  if (!std::filesystem::exists(newest, ignored) && !std::filesystem::exists(older, ignored)) {
    throw FileError(folder.string(), "there is no checkpoint (run.checkpoint) to go on from");
  }
  std::string warning;
  try {
    return {newest, read_sound_checkpoint(newest), {}};
  } catch (const FileError& error) {
    warning = error.what();
  }
  try {
    return {older, read_sound_checkpoint(older), warning + "; going on from " + older.string()};
  } catch (const FileError& error) {
    throw FileError(warning + "\n" + error.what());
  }
}

}  // namespace

FoundCheckpoint find_checkpoint(const parallel::Comm& comm, const std::filesystem::path& path,
                                const Log& log) {
  Content content;
  on_root(comm, [&] {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
      content = read_newest(path);
    } else if (path.filename() == "run.h5") {
      content = read_newest(path.parent_path());
    } else {
      content = {path, read_sound_checkpoint(path), {}};
    }
  });
  if (!content.warning.empty()) log.warning(content.warning);
  const std::filesystem::path file = comm.broadcast(content.file.string());
  return {file.parent_path(), file, Snapshot::decode(comm.broadcast(content.bytes))};
}

void check_resumed_deck(const Catalogue& catalogue, const Options& deck, const Snapshot& snapshot) {
  const Options before = read_deck(catalogue, DeckSource::restore(snapshot));
  if (identity_of(before) != snapshot.text("run/deck")) {
    throw FileError(
        "the checkpoint belongs to another deck: what it holds of its own now means something "
        "else, "
        "as with another version of culm");
  }
  const auto analysis = static_cast<std::size_t>(snapshot.integer("run/analysis"));
  find_forbidden_changes(before, deck, analysis, snapshot.number("state/time"),
                         catalogue.analyses.follows_path)
      .throw_if_any();
}

std::string describe(const FoundCheckpoint& found, const Options& deck) {
  const auto analysis = static_cast<std::size_t>(found.snapshot.integer("run/analysis"));
  return fmt::format("going on from {}: {} at {:.8g}, after {} steps", found.file.string(),
                     deck.list("Analyses").entries()[analysis].name(),
                     found.snapshot.number("state/time"),
                     found.snapshot.integer("output/rows") - 1);
}

void warn_of_differences(const parallel::Comm& comm, const Snapshot& snapshot, const Log& log) {
  const int ranks = snapshot.integer("run/ranks");
  if (ranks != comm.size()) {
    log.warning(
        fmt::format("the run had {} process{} and goes on with {}: results will differ in "
                    "the last digits",
                    ranks, ranks == 1 ? "" : "es", comm.size()));
  }
  if (snapshot.text("run/version") != version) {
    log.warning(fmt::format("the run began with culm {} and goes on with {}: results may differ",
                            snapshot.text("run/version"), version));
  }
}

}  // namespace culm::simulation
