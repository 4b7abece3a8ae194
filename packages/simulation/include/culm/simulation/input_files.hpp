/// Files that a deck reads, so that nothing writes over them.
#pragma once

#include <culm/base/options.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/read_deck.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::simulation {

/// The deck and its includes, its tables and meshes (parameters "File Name"), and the files of
/// other runs that it starts from or takes shapes from; those that are there.
std::vector<std::filesystem::path> find_input_files(const Options& deck, const DeckSource& source);

/// Tables, meshes and other files that the lists of a deck name (parameters "File Name").
std::vector<std::filesystem::path> find_named_files(const Options& deck);

/// Throws FileError where a file that the deck names would be another one if the deck stood in
/// `folder`, as its resolved form does.
void refuse_other_files(const Options& deck, const std::filesystem::path& folder);

/// Throws FileError on all ranks if a file to be written is one of the inputs, under this name or,
/// by links, another one.
void refuse_overwriting(const parallel::Comm& comm,
                        const std::vector<std::filesystem::path>& inputs,
                        const std::filesystem::path& output);

/// The same for all that a run writes into a folder.
void refuse_overwriting_by_run(const parallel::Comm& comm,
                               const std::vector<std::filesystem::path>& inputs,
                               const std::filesystem::path& folder);

}  // namespace culm::simulation
