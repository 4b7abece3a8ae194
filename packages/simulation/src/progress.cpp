#include <culm/simulation/progress.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace culm::simulation {

Progress::Progress(const Log& log, bool quiet, bool terminal)
    : log_(log), quiet_(quiet), terminal_(terminal) {}

void Progress::begin(const std::string& analysis) {
  analysis_ = analysis;
  tenth_ = 0;
  first_.reset();
  start_ = std::chrono::steady_clock::now();
}

std::string Progress::line(const analysis::StepReport& report) const {
  const auto& history = report.outcome.history;
  const double residual = history.empty() ? 0.0 : history.back().force;
  const char* fate = report.accepted ? "" : ", cut back";
  if (!std::isfinite(report.final_time)) {
    return fmt::format("{}: {:.4g}, step {}, {} iterations, residual {:.1e}{}", analysis_,
                       report.time, report.step, report.outcome.iterations, residual, fate);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  const double done = report.time / report.final_time;
  const double way = done - *first_;
  const double left = way > 0.0 ? spent.count() * (1.0 - done) / way : 0.0;
  return fmt::format(
      "{}: {:.4g} of {:.4g}, step {}, {} iterations, residual {:.1e}, {:.0f} s left{}", analysis_,
      report.time, report.final_time, report.step, report.outcome.iterations, residual, left, fate);
}

void Progress::show(const analysis::StepReport& report) {
  if (quiet_) return;
  // a run that was resumed begins on the way
  if (!first_) first_ = std::max(0.0, report.time - report.increment) / report.final_time;
  if (terminal_) {
    std::fputs(fmt::format("\r\033[K{}", line(report)).c_str(), stdout);
    std::fflush(stdout);
    open_ = true;
    return;
  }
  // where the end is not known, every tenth step instead of every tenth of the way
  const int tenth = std::isfinite(report.final_time)
                        ? static_cast<int>(10.0 * report.time / report.final_time + 1e-9)
                        : report.step / 10;
  if (!report.accepted || tenth > tenth_) log_.info(line(report));
  if (report.accepted) tenth_ = tenth;
}

void Progress::end() {
  if (open_) std::fputs("\n", stdout);
  open_ = false;
}

}  // namespace culm::simulation
