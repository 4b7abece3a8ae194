#include <culm/base/error.hpp>
#include <culm/base/findings.hpp>
#include <culm/openfast/import.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/simulation/stop_request.hpp>

#include "command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace culm::app {

namespace {

void refuse_existing(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored))) {
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

// A folder that vanishes; the same on all ranks.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const parallel::Comm& comm) : comm_(comm) {
    const auto name = "culm import " + std::to_string(getpid());
    path_ = comm.broadcast((std::filesystem::temp_directory_path() / name).string());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (comm_.is_root()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  parallel::Comm comm_;
  std::filesystem::path path_;
};

// Frequencies [Hz] of one model, or why there are none.
struct Frequencies {
  std::string name;
  std::vector<double> values;
  std::string failure;
};

// The second column of the table of modes.
std::vector<double> read_frequencies(const std::filesystem::path& table) {
  std::ifstream stream(table);
  std::vector<double> found;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::string mode;
    std::string frequency;
    std::getline(cells, mode, ',');
    std::getline(cells, frequency, ',');
    found.push_back(std::stod(frequency));
  }
  return found;
}

// Runs a deck, for the frequencies of its modes.
Frequencies find_frequencies(const parallel::Comm& comm, const std::string& name,
                             simulation::Simulation& model) {
  const TemporaryFolder folder(comm);
  const simulation::StopRequest request;
  try {
    model.run({folder.path(), true, false}, request);
  } catch (const NumericalError& error) {
    return {name, {}, fmt::format("not found, the deck does not solve: {}", error.what())};
  } catch (const PromiseBroken& broken) {
    return {name, read_frequencies(folder.path() / "analyses" / "modes" / "modes.csv"),
            broken.what()};
  }
  return {name, read_frequencies(folder.path() / "analyses" / "modes" / "modes.csv"), {}};
}

// The frequencies side by side, each column in rising order.
std::string frequency_table(const std::vector<Frequencies>& models) {
  std::string text = "         ";
  for (const Frequencies& one : models) text += fmt::format(" {:>20}", one.name);
  text += "\n";
  for (std::size_t i = 0; i < models.front().values.size(); ++i) {
    text += fmt::format("  mode {:>2}", i + 1);
    for (const Frequencies& one : models) {
      text += i < one.values.size() ? fmt::format(" {:>17.5g} Hz", one.values[i])
                                    : fmt::format(" {:>20}", "");
    }
    text += "\n";
  }
  for (const Frequencies& one : models) {
    if (!one.failure.empty()) text += fmt::format("  {}: {}\n", one.name, one.failure);
  }
  return text;
}

bool has_modes(const Options& deck) {
  for (const Options& analysis : deck.list("Analyses").entries()) {
    if (analysis.text("Type") == "Modal") return true;
  }
  return false;
}

}  // namespace

void import_openfast(const parallel::Comm& comm, const ImportArguments& arguments) {
  const Log log(arguments.quiet ? LogLevel::quiet : LogLevel::info, comm.rank());
  const Log silent(LogLevel::quiet, comm.rank());
  const std::filesystem::path deck_path =
      arguments.deck.empty() ? arguments.file.filename().replace_extension(".xml") : arguments.deck;
  std::filesystem::path report_path = deck_path;
  report_path.replace_extension(".report.txt");
  refuse_existing(deck_path);
  refuse_existing(report_path);
  openfast::TurbineOptions turbine = arguments.turbine;
  turbine.folder = deck_path.parent_path();
  openfast::Imported imported = openfast::import_file(arguments.file, turbine);
  // What is written is a deck that builds; its masses and modes belong to the report.
  const simulation::Catalogue catalogue;
  simulation::DeckSource source{{{deck_path.string(), imported.deck}}, {}};
  source.overrides = imported.only_modes;
  const Options deck = simulation::read_deck(catalogue, source);
  simulation::Simulation model(comm, catalogue, deck, source, silent);
  imported.report += "\nthe model\n" + model.summary();
  if (has_modes(deck)) {
    std::vector<Frequencies> found{find_frequencies(comm, "as imported", model)};
    for (const openfast::Variant& variant : imported.variants) {
      source.overrides = imported.only_modes;
      source.overrides.insert(source.overrides.end(), variant.settings.begin(),
                              variant.settings.end());
      const Options changed = simulation::read_deck(catalogue, source);
      simulation::Simulation other(comm, catalogue, changed, source, silent);
      found.push_back(find_frequencies(comm, variant.name, other));
    }
    imported.report += "\nfrequencies of the model\n" + frequency_table(found);
  }
  if (comm.is_root()) write_both({deck_path, imported.deck}, {report_path, imported.report});
  log.info(imported.report + "\nwritten: " + deck_path.string() + ", " + report_path.string());
}

}  // namespace culm::app
