#include "other_run.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/output/checksum.hpp>
#include <culm/output/recorder.hpp>
#include <culm/simulation/result_files.hpp>
#include <culm/simulation/resume.hpp>

#include "checkpoints.hpp"
#include "memories.hpp"
#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace culm::simulation {
namespace {

using Path = std::filesystem::path;

std::string sum_of(const model::Model& model, const model::Structure& structure) {
  std::uint64_t sum = output::checksum({});
  for (const int node : structure.nodes) {
    const model::NodeSlots slots = model::NodeTable::slots(model.nodes().reference(), node);
    sum = output::checksum(std::as_bytes(std::span(slots.data(), 12)), sum);
  }
  return fmt::format("{:016x}", sum);
}

std::string key(std::string_view what, std::size_t number) {
  return fmt::format("run/structure {}/{}", number, what);
}

// The checkpoint of a folder, its run.h5 or itself.
Path checkpoint_named(const Path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return checkpoint_path(path);
  return path.filename() == "run.h5" ? checkpoint_path(path.parent_path()) : path;
}

std::string read_text_of_newest(const Path& file) {
  try {
    return read_sound_checkpoint(file);
  } catch (const FileError& error) {
    const Path older = output::previous_checkpoint(file);
    std::error_code ignored;
    if (!std::filesystem::exists(older, ignored)) throw;
    throw FileError(std::string(error.what()) + "; 'Start From' may name " + older.string() +
                    ", the state before");
  }
}

// Both must be of one run; a checkpoint may also be kept without results.
void check_results(const Path& run, const Snapshot& snapshot) {
  std::error_code ignored;
  if (!std::filesystem::exists(run, ignored)) return;
  output::recover_run(run);
  output::find_recorded(run, snapshot.text("run/id"), restore_mark(snapshot));
}

// Who keeps numbers of a list, in its order, and how many.
struct Owner {
  std::string name;
  std::size_t size = 0;
};
using Owners = std::vector<Owner>;

Owners owners_of_memories(const model::Model& model) {
  Owners owners;
  for (const model::Batch* batch : model.batches()) {
    if (batch->memory_size() > 0) owners.push_back({batch->effect().title(), batch->memory_size()});
  }
  return owners;
}

Owners owners_of_signals(const model::Model& model) {
  Owners owners;
  for (const model::OwnBlock& block : model.own_blocks()) {
    owners.push_back({block.name, block.unknowns.size()});
  }
  return owners;
}

Owners owners_of_watched(const std::vector<WatchedQuantity>& watched) {
  Owners owners;
  for (const WatchedQuantity& one : watched) {
    const std::size_t size = one.quantity->memory().size();
    if (size > 0) owners.push_back({one.name, size});
  }
  return owners;
}

std::string owner_key(const char* one, const char* what, std::size_t i) {
  return fmt::format("run/{} {} {}", one, what, i);
}

void save_owners(const char* all, const char* one, const Owners& owners, Snapshot& snapshot) {
  for (std::size_t i = 0; i < owners.size(); ++i) {
    snapshot.set_text(owner_key(one, "of", i), owners[i].name);
    snapshot.set(owner_key(one, "size", i), static_cast<double>(owners[i].size));
  }
  snapshot.set(fmt::format("run/{}", all), static_cast<double>(owners.size()));
}

// A list of numbers, and how a checkpoint names its owners.
struct Kept {
  const char *all, *one, *values;
};

// What belongs to each name; of equal names the first comes first.
using Numbers = std::multimap<std::string, std::span<const double>>;

// Those of another run; nothing where a checkpoint of before does not say whose they are.
std::optional<Numbers> numbers_of(const Kept& kept, const Snapshot& other) {
  const std::string count = fmt::format("run/{}", kept.all);
  if (!other.has(count)) return {};
  std::span<const double> rest = other.numbers(kept.values);
  Numbers there;
  for (std::size_t i = 0; i < static_cast<std::size_t>(other.integer(count)); ++i) {
    const auto size = static_cast<std::size_t>(other.integer(owner_key(kept.one, "size", i)));
    there.emplace(other.text(owner_key(kept.one, "of", i)), rest.first(size));
    rest = rest.subspan(size);
  }
  return there;
}

// Moves them to owners of the same name and size, and leaves what has no place here.
// @return names of the owners that got nothing
std::vector<std::string> move(const Kept& kept, const Owners& owners, Numbers& there,
                              Snapshot& snapshot) {
  std::vector<std::string> without;
  std::vector<double> values = snapshot.copy(kept.values);
  auto to = values.begin();
  for (const Owner& owner : owners) {
    const auto found = there.find(owner.name);
    if (found != there.end() && found->second.size() == owner.size) {
      std::ranges::copy(found->second, to);
      there.erase(found);
    } else {
      without.push_back(owner.name);
    }
    to += static_cast<std::ptrdiff_t>(owner.size);
  }
  snapshot.set(kept.values, std::move(values));
  return without;
}

// @return names of what keeps something there and has no place here
std::vector<std::string> take(const Kept& kept, const Owners& owners, const Snapshot& other,
                              Snapshot& snapshot) {
  const auto is_empty = [](std::span<const double> numbers) {
    return std::ranges::all_of(numbers, [](double one) { return one == 0.0; });
  };
  std::vector<std::string> lost;
  std::optional<Numbers> known = numbers_of(kept, other);
  if (!known) {
    if (!is_empty(other.numbers(kept.values))) lost.push_back("the model");
    return lost;
  }
  Numbers& there = *known;
  move(kept, owners, there, snapshot);
  for (const auto& [name, numbers] : there) {
    if (!is_empty(numbers)) lost.push_back(name);
  }
  return lost;
}

std::vector<std::string> structures_of(const Snapshot& snapshot) {
  std::vector<std::string> names(static_cast<std::size_t>(snapshot.integer("run/structures")));
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = snapshot.text(key("name", i));
  return names;
}

// What is not the same there, or nothing.
std::string difference(const Snapshot& snapshot, const model::Model& model) {
  const std::vector<std::string> there = structures_of(snapshot);
  std::size_t i = 0;
  for (const model::Structure& structure : model.structures()) {
    const bool is_here = i < there.size() && there[i] == structure.name;
    if (!is_here && std::ranges::find(there, structure.name) != there.end()) {
      return fmt::format(
          "it has '{}' in another place of the list of structures, whose order counts",
          structure.name);
    }
    if (!is_here) {
      return fmt::format("it has no structure '{}' in this place{}", structure.name,
                         did_you_mean(structure.name, there));
    }
    const int nodes = snapshot.integer(key("nodes", i));
    if (nodes != static_cast<int>(structure.nodes.size())) {
      return fmt::format("its '{}' has {} nodes, that of this model {}", structure.name, nodes,
                         structure.nodes.size());
    }
    if (snapshot.text(key("sum", i)) != sum_of(model, structure)) {
      return fmt::format("its '{}' has other nodes in the reference than that of this model",
                         structure.name);
    }
    ++i;
  }
  return i == there.size() ? "" : fmt::format("it has a structure '{}' more", there[i]);
}

}  // namespace

void save_structures(const model::Model& model, Snapshot& snapshot) {
  std::size_t i = 0;
  for (const model::Structure& structure : model.structures()) {
    snapshot.set_text(key("name", i), structure.name);
    snapshot.set(key("nodes", i), static_cast<double>(structure.nodes.size()));
    snapshot.set_text(key("sum", i), sum_of(model, structure));
    ++i;
  }
  snapshot.set("run/structures", static_cast<double>(i));
}

void save_memory_owners(const model::Model& model, Snapshot& snapshot) {
  save_owners("memories", "memory", owners_of_memories(model), snapshot);
  save_owners("signals", "signal", owners_of_signals(model), snapshot);
}

std::vector<std::string> take_memories(const Snapshot& other, const model::Model& model,
                                       Snapshot& snapshot) {
  std::vector<std::string> lost =
      take({"memories", "memory", "system/batches"}, owners_of_memories(model), other, snapshot);
  for (std::string& name :
       take({"signals", "signal", "state/own"}, owners_of_signals(model), other, snapshot)) {
    lost.push_back(std::move(name));
  }
  return lost;
}

void save_watched(const std::vector<WatchedQuantity>& watched, Snapshot& snapshot) {
  save_owners("watched", "watched", owners_of_watched(watched), snapshot);
}

std::vector<std::string> take_watched(const Snapshot& other,
                                      const std::vector<WatchedQuantity>& watched,
                                      Snapshot& snapshot) {
  const Kept kept{"watched", "watched", memories_key};
  Numbers there = numbers_of(kept, other).value_or(Numbers{});
  std::vector<std::string> without = move(kept, owners_of_watched(watched), there, snapshot);
  std::erase_if(without, [&](const std::string& name) {
    const auto one = std::ranges::find(watched, name, &WatchedQuantity::name);
    return !one->quantity->relies_on_memory();
  });
  return without;
}

Snapshot find_state_of_run(const parallel::Comm& comm, const Options& analysis,
                           const model::Model& model) {
  const Path path = analysis.text("Start From");
  const Path file = checkpoint_named(path);
  std::string content;
  on_root(comm, [&] {
    content = read_text_of_newest(file);
    if (file != path) check_results(file.parent_path() / "run.h5", Snapshot::decode(content));
  });
  Snapshot snapshot = Snapshot::decode(comm.broadcast(content));
  if (const std::string found = difference(snapshot, model); !found.empty()) {
    throw InputError(
        analysis.where("Start From"),
        fmt::format("the run in '{}' has not the same structures: {}", path.string(), found));
  }
  return snapshot;
}

}  // namespace culm::simulation
