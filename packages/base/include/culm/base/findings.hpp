#pragma once

#include <culm/base/error.hpp>
#include <culm/base/log.hpp>
#include <culm/base/snapshot.hpp>

#include <string>
#include <vector>

namespace culm {

/// Something about a run that its user must know, although the run goes on.
struct Finding {
  /// How much it weighs.
  enum class Grade {
    warning,  ///< a result may mean less than it seems to
    broken,   ///< what culm promises does not hold
  };

  Grade grade = Grade::warning;
  std::string kind;      ///< one or two words that scripts may compare, such as "certificate"
  std::string text;      ///< a sentence without full stop: what, where, how much
  std::string analysis;  ///< the analysis in which it was found; empty if none has begun
  double time = 0.0;     ///< [s], or load level
};

/// Collects the findings of a run. Each is said once, as a warning, when it is added; result files,
/// pages and the exit code follow from the list. Whoever adds one does so on all ranks alike.
class Findings {
 public:
  explicit Findings(Log log) : log_(std::move(log)) {}

  /// Findings belong to this analysis from now on.
  void begin(std::string analysis) { analysis_ = std::move(analysis); }
  /// Adds a finding, unless the analysis has the same one already.
  /// @param time  [s], or load level
  void warn(const std::string& kind, const std::string& text, double time);
  /// The same where a promise does not hold.
  void broken(const std::string& kind, const std::string& text, double time);

  const std::vector<Finding>& all() const { return list_; }
  /// Names the broken promises in one line; empty if there is none.
  /// @param strict  warnings count as broken promises
  std::string verdict(bool strict) const;

  /// Under "findings/".
  void save(Snapshot& snapshot) const;
  /// Takes over those of the run that goes on, and says them again.
  void restore(const Snapshot& snapshot);

 private:
  void add(Finding finding);

  Log log_;
  std::string analysis_;
  std::vector<Finding> list_;
};

/// A run came to its end and wrote all results, but a promise does not hold. The text names it.
class PromiseBroken final : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 8; }
};

}  // namespace culm
