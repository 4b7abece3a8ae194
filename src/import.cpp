#include <culm/base/error.hpp>
#include <culm/openfast/import.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>

#include "command.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace culm::app {

namespace {

void refuse_existing(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) {
    throw FileError(path.string(),
                    "exists and may have been edited: remove it, or name another "
                    "file with --output");
  }
}

void write_new(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (stream) return;
  const int error = errno;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw FileError(path.string(), "cannot write: " + std::generic_category().message(error));
}

using NewFile = std::pair<std::filesystem::path, std::string>;

// Neither stays without the other.
void write_both(const NewFile& deck, const NewFile& report) {
  write_new(report.first, report.second);
  try {
    write_new(deck.first, deck.second);
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(report.first, ignored);
    throw;
  }
}

}  // namespace

void import_openfast(const parallel::Comm& comm, const ImportArguments& arguments) {
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const std::filesystem::path deck_path =
      arguments.deck.empty() ? arguments.file.filename().replace_extension(".xml") : arguments.deck;
  std::filesystem::path report_path = deck_path;
  report_path.replace_extension(".report.txt");
  refuse_existing(deck_path);
  refuse_existing(report_path);
  openfast::Imported imported = openfast::import_file(arguments.file, arguments.turbine);
  // What is written is a deck that builds; its masses belong to the report.
  const simulation::Catalogue catalogue;
  const simulation::DeckSource source{{{deck_path.string(), imported.deck}}, {}};
  const Options deck = simulation::read_deck(catalogue, source);
  const simulation::Simulation model(comm, catalogue, deck, source, log);
  imported.report += "\nthe model\n" + model.summary();
  if (comm.is_root()) write_both({deck_path, imported.deck}, {report_path, imported.report});
  log.info(imported.report + "\nwritten: " + deck_path.string() + ", " + report_path.string());
}

}  // namespace culm::app
