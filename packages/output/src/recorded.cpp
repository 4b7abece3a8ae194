#include <culm/base/error.hpp>
#include <culm/output/recorded.hpp>

#include "hdf5_read.hpp"

#include <fmt/core.h>

namespace culm::output {

Recorded find_recorded(const std::filesystem::path& path, std::size_t steps, std::size_t rows) {
  const QuietHdf5 quiet;
  const Hdf5File file = Hdf5File::open(path);
  Recorded recorded{read_steps(file), {}};
  const Shape shape = read_shape(file, file.id(), "history/values");
  if (recorded.steps.size() < steps || shape.size() != 2 || shape[0] < rows) {
    throw FileError(path.string(),
                    fmt::format("holds {} states and {} steps of the history, fewer than the {} "
                                "and {} of the checkpoint",
                                recorded.steps.size(), shape.front(), steps, rows));
  }
  recorded.steps.resize(steps);
  recorded.history = read_doubles(file, file.id(), "history/values");
  recorded.history.resize(rows * shape[1]);
  return recorded;
}

}  // namespace culm::output
