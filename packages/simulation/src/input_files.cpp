#include <culm/base/error.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/simulation/input_files.hpp>

#include "checkpoints.hpp"
#include "on_root.hpp"

#include <algorithm>
#include <array>

namespace culm::simulation {
namespace {

using Path = std::filesystem::path;

// What potential flow reads beside NAME.1.
void add_beside(const Path& file, std::vector<Path>& files) {
  if (file.extension() != ".1") return;
  for (const char* ending : {".3", ".hst"}) {
    Path other = file;
    other.replace_extension(ending);
    std::error_code failure;
    if (std::filesystem::is_regular_file(other, failure)) files.push_back(std::move(other));
  }
}

// Calls action(parameter, folder, name) for each file that a list names, relative to a folder.
template <class Action>
void visit_named_files(const Options& list, const Action& action) {
  for (const Options::Parameter& parameter : list.parameters()) {
    if (!parameter.value) continue;
    const Path folder = Path(parameter.where.file).parent_path();
    if (parameter.name == "File Name") action(parameter, folder, list.text(parameter.name));
    if (parameter.name != "File Names") continue;
    for (const std::string& name : list.texts(parameter.name)) action(parameter, folder, name);
  }
  for (const auto* lists : {&list.lists(), &list.entries()}) {
    for (const Options& below : *lists) visit_named_files(below, action);
  }
}

// What a path to another run may mean: its folder, or a file in it.
void add_run(const Path& path, std::vector<Path>& files) {
  for (const Path& file : {path, path / "run.h5", checkpoint_path(path),
                           output::previous_checkpoint(checkpoint_path(path))}) {
    files.push_back(file);
  }
}

bool is_same_file(const Path& a, const Path& b) {
  std::error_code failure;  // if one of them is not there
  return std::filesystem::equivalent(a, b, failure);
}

void refuse(const Path& output, const Path& input) {
  throw FileError(output.string(), "is read by the deck" +
                                       (output == input ? "" : ", as " + input.string() + ",") +
                                       " and would be overwritten; write elsewhere");
}

// Folders that are emptied, or filled with files by numbers.
bool is_within_results(const Path& file, const Path& folder) {
  std::error_code failure;
  const Path inside = std::filesystem::weakly_canonical(file, failure)
                          .lexically_relative(std::filesystem::weakly_canonical(folder, failure));
  return !inside.empty() && (*inside.begin() == "analyses" || *inside.begin() == "run_vtu");
}

}  // namespace

std::vector<Path> find_named_files(const Options& deck) {
  std::vector<Path> files;
  visit_named_files(
      deck, [&](const Options::Parameter& parameter, const Path& folder, const std::string& name) {
        const Path file = folder / name;
        files.push_back(file);
        if (parameter.name == "File Name") add_beside(file, files);
      });
  return files;
}

void refuse_other_files(const Options& deck, const Path& folder) {
  visit_named_files(deck, [&](const Options::Parameter& parameter, const Path& its_folder,
                              const std::string& name) {
    const Path there = folder / name;
    std::error_code failure;
    if (!std::filesystem::exists(there, failure) || is_same_file(there, its_folder / name)) return;
    throw FileError(there.string(), "would be read in place of " + (its_folder / name).string() +
                                        ", which " + to_string(parameter.where) +
                                        " means; write elsewhere");
  });
}

std::vector<Path> find_input_files(const Options& deck, const DeckSource& source) {
  std::vector<Path> files = find_named_files(deck);
  for (const deck::DeckText& text : source.texts) files.emplace_back(text.name);
  for (const Options& entry : deck.list("Imperfections").entries()) {
    if (entry.has("Run")) add_run(entry.text("Run"), files);
  }
  for (const Options& entry : deck.list("Analyses").entries()) {
    if (entry.has("Start From")) add_run(entry.text("Start From"), files);
  }
  std::erase_if(files, [](const Path& file) {
    std::error_code failure;
    return !std::filesystem::is_regular_file(file, failure);
  });
  return files;
}

void refuse_overwriting(const parallel::Comm& comm, const std::vector<Path>& inputs,
                        const Path& output) {
  on_root(comm, [&] {
    for (const Path& input : inputs) {
      if (is_same_file(input, output)) refuse(output, input);
    }
  });
}

void refuse_overwriting_by_run(const parallel::Comm& comm, const std::vector<Path>& inputs,
                               const Path& folder) {
  constexpr std::array names = {"run.h5",      "run.h5.part",    "run.h5.journal",
                                "run.xdmf",    "run.pvd",        "run_skin.pvd",
                                "history.csv", "run.checkpoint", "run.checkpoint.old",
                                "report.html", "run.lock"};
  on_root(comm, [&] {
    for (const Path& input : inputs) {
      for (const char* name : names) {
        if (is_same_file(input, folder / name)) refuse(folder / name, input);
      }
      if (is_within_results(input, folder)) refuse(input, input);
    }
  });
}

}  // namespace culm::simulation
