#include <culm/base/error.hpp>
#include <culm/output/recorded.hpp>

#include "content_sum.hpp"
#include "hdf5_read.hpp"
#include "names.hpp"

#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
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

// HDF5 trusts some numbers of a file, such as lengths of texts: over wrong ones it ends the
// process, or cannot be closed any more. So a child reads first, and tells what is wrong.
void survive_reading(const std::filesystem::path& path, const std::string& run,
                     const RecordMark& mark) {
  std::array<int, 2> channel{};
  if (::pipe(channel.data()) != 0) return;
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) ::signal(signal, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::close(STDERR_FILENO);
    try {
      read_recorded(path, run, mark);
      H5garbage_collect();  // looks over memory that may be spoilt
    } catch (const std::exception& error) {
      const std::string text = error.what();
      if (::write(channel[1], text.data(), text.size()) < 0) ::abort();
    }
    ::_exit(0);
  }
  ::close(channel[1]);
  std::string text;
  std::array<char, 4096> block{};
  ssize_t count = 0;
  while (child > 0 && (count = ::read(channel[0], block.data(), block.size())) != 0) {
    if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  ::close(channel[0]);
  if (child < 0) return;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) throw FileError(path.string(), "is damaged: HDF5 cannot read it");
  if (!text.empty()) throw FileError(text);
}

}  // namespace

Recorded find_recorded(const std::filesystem::path& path, const std::string& run,
                       const RecordMark& mark) {
  survive_reading(path, run, mark);
  return read_recorded(path, run, mark);
}

}  // namespace culm::output
