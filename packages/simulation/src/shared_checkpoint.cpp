#include "shared_checkpoint.hpp"

#include <culm/output/checkpoint_file.hpp>
#include <culm/output/checksum.hpp>
#include <culm/parallel/shared_file.hpp>

#include "on_root.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace culm::simulation {
namespace {

std::uint64_t numbers_in(const Snapshot::Table& table) { return table.rows * table.width; }

// One table after the other, so that not all of them are in memory together.
// @param write  given a table, its numbers, and how many numbers are before it
// @return the checksum of what this rank has
template <class Write>
std::uint64_t write_tables(const Snapshot& snapshot, const Write& write) {
  std::uint64_t sum = 0;
  std::uint64_t before = 0;
  for (const Snapshot::Table& table : snapshot.tables()) {
    const std::vector<double> numbers = table.find();
    write(table, numbers, before);
    sum += output::sum_of_rows(table.own, table.width, numbers, before);
    before += numbers_in(table);
  }
  return sum;
}

std::uint64_t write_shared_tables(const parallel::Comm& comm, const std::filesystem::path& name,
                                  std::uint64_t place, const Snapshot& snapshot) {
  parallel::SharedFile file(comm, name);
  const std::uint64_t sum = write_tables(
      snapshot,
      [&](const Snapshot::Table& table, std::span<const double> numbers, std::uint64_t before) {
        file.write(place + before * sizeof(double), table.width, table.own, numbers);
      });
  file.sync();
  return comm.wrapping_sum(sum);
}

}  // namespace

void write_shared_checkpoint(const parallel::Comm& comm, const std::filesystem::path& path,
                             const Snapshot& snapshot) {
  std::optional<output::CheckpointFile> file;
  std::uint64_t place = 0;
  on_root(comm, [&] {
    file.emplace(path);
    snapshot.encode([&](std::string_view piece) { file->take(piece); });
    std::uint64_t count = 0;
    for (const Snapshot::Table& table : snapshot.tables()) count += numbers_in(table);
    place = file->make_room(count);
  });
  std::uint64_t sum = 0;
  if (comm.size() == 1) {
    sum = write_tables(snapshot, [&](const Snapshot::Table&, std::span<const double> numbers,
                                     std::uint64_t) { file->fill_room(numbers); });
  } else if (!snapshot.tables().empty()) {
    const std::string name = comm.broadcast(file ? file->name().string() : std::string());
    comm.broadcast(std::span(&place, 1));
    sum = write_shared_tables(comm, name, place, snapshot);
  }
  on_root(comm, [&] { file->finish(sum); });
}

}  // namespace culm::simulation
