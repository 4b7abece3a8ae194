#include <culm/base/error.hpp>
#include <culm/output/recorded.hpp>

#include "content_sum.hpp"
#include "hdf5_read.hpp"
#include "names.hpp"
#include "survive_reading.hpp"

#include <fmt/core.h>

#include <span>

namespace culm::output {
namespace {

void check_run(const Hdf5File& file, const std::string& run) {
  const std::string found = has_attribute(file, "run") ? read_text(file, file.id(), "run") : "none";
  if (found == run) return;
  throw FileError(
      file.path().string(),
      fmt::format("is not the result file of this checkpoint: it belongs to run {}, the "
                  "checkpoint to run {}",
                  found, run));
}

void check_sum(const Hdf5File& file, std::uint64_t found, std::uint64_t written,
               const std::string& what) {
  if (found == written) return;
  throw FileError(file.path().string(),
                  fmt::format("is damaged: {} are not what was written", what));
}

std::vector<Recorded::Step> find_steps(const Hdf5File& file, const RecordMark& mark) {
  std::vector<Recorded::Step> steps = read_steps(file);
  if (steps.size() < mark.steps) {
    throw FileError(file.path().string(), fmt::format("holds {} states, fewer than the {} of the "
                                                      "checkpoint",
                                                      steps.size(), mark.steps));
  }
  steps.resize(mark.steps);
  const Handle group = open_group(file, file.id(), "steps");
  std::uint64_t sum = 0;
  for (const Recorded::Step& step : steps) {
    sum += sum_of_group(file, group.id(), step_name(step.index));
  }
  check_sum(file, sum, mark.steps_sum, "recorded states");
  return steps;
}

std::vector<double> find_history(const Hdf5File& file, const RecordMark& mark) {
  const Shape shape = read_shape(file, file.id(), "history/values");
  if (shape.size() != 2 || shape[0] < mark.rows) {
    throw FileError(file.path().string(), fmt::format("holds {} steps of the history, fewer than "
                                                      "the {} of the checkpoint",
                                                      shape.empty() ? 0 : shape[0], mark.rows));
  }
  std::vector<double> history = read_doubles(file, file.id(), "history/values");
  history.resize(mark.rows * shape[1]);
  std::uint64_t sum = 0;
  for (std::size_t row = 0; row < mark.rows; ++row) {
    sum = chain(sum, std::as_bytes(std::span(history).subspan(row * shape[1], shape[1])));
  }
  check_sum(file, sum, mark.history_sum, "rows of the history");
  return history;
}

void check_results(const Hdf5File& file, const RecordMark& mark) {
  if (mark.results.empty()) return;
  const Handle group = open_group(file, file.id(), "analyses");
  for (const auto& [name, sum] : mark.results) {
    check_sum(file, sum_of_group(file, group.id(), link_name(name)), sum,
              "the results of '" + name + "'");
  }
}

Recorded read_recorded(const std::filesystem::path& path, const std::string& run,
                       const RecordMark& mark) {
  const QuietHdf5 quiet;
  const Hdf5File file = Hdf5File::open(path);
  check_run(file, run);
  Recorded recorded{find_steps(file, mark), find_history(file, mark)};
  check_results(file, mark);
  return recorded;
}

}  // namespace

Recorded find_recorded(const std::filesystem::path& path, const std::string& run,
                       const RecordMark& mark) {
  survive_reading(path, [&] { read_recorded(path, run, mark); });
  return read_recorded(path, run, mark);
}

}  // namespace culm::output
