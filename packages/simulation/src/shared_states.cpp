#include "shared_states.hpp"

#include <culm/base/error.hpp>
#include <culm/output/checksum.hpp>
#include <culm/parallel/owned_numbers.hpp>

#include "on_root.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace culm::simulation {
namespace {

constexpr std::size_t smallest_shared = 8192;  // numbers; below it sending them costs less
constexpr std::uint64_t no_room = std::numeric_limits<std::uint64_t>::max();

}  // namespace

void SharedStates::record(const PicturePart& part, const output::Picture& picture,
                          output::Recorder* recorder) {
  const output::StateTables& tables = part.tables();
  on_root(comm_, [&] { recorder->begin(picture); });
  for (std::size_t t = 0; t < tables.tables().size(); ++t) {
    record_table(t, tables, part, picture, recorder);
  }
  on_root(comm_, [&] { recorder->end(); });
}

void SharedStates::record_table(std::size_t t, const output::StateTables& tables,
                                const PicturePart& part, const output::Picture& picture,
                                output::Recorder* recorder) {
  const std::size_t rows = tables.tables()[t].rows;
  const auto width = static_cast<std::size_t>(tables.tables()[t].columns);
  const RowRanges own = tables.rows(t, part.rows());
  std::vector<double> numbers = tables.values(t, part.meshes(), picture.structures);
  std::uint64_t place = no_room;
  if (comm_.size() > 1 && rows * width >= smallest_shared) {
    on_root(comm_, [&] { place = recorder->room_of(t).value_or(no_room); });
    comm_.broadcast(std::span(&place, 1));
  }
  if (place == no_room) {
    numbers = parallel::gather_rows(comm_, rows, width, own, std::move(numbers));
    on_root(comm_, [&] { recorder->put(t, numbers); });
    return;
  }
  if (!file_) file_.emplace(comm_, path_);
  file_->write(place, width, own, numbers);
  const std::uint64_t sum = comm_.wrapping_sum(output::sum_of_rows(own, width, numbers));
  internal_check(comm_.wrapping_sum(count_rows(own)) == rows, "each row of a state is on one rank");
  if (recorder != nullptr) recorder->note(t, sum);
}

}  // namespace culm::simulation
