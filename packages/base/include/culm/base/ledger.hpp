#pragma once

#include <culm/base/cycle_clock.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm {

/// What each effect of a run contains and costs. An effect registers once and times its work with a
/// Scope, the only timer of culm. Time is counted where it is spent: a scope opened inside another
/// pauses the outer one, so the shares of the report add up to the whole. For one thread.
class Ledger {
 public:
  using Clock = std::chrono::steady_clock;
  /// What tells the time: a plain function, because scopes ask in hot loops.
  using Now = Clock::time_point (*)();

  Ledger() : Ledger(&cycle_time) {}
  explicit Ledger(Now now) : now_(now) {}

  /// Handed out at registration.
  using Id = int;

  /// One effect. Counts that make no sense for it stay empty and print as a dash.
  struct Entry {
    std::string name;
    std::optional<long long> items;                  ///< elements, joints, loads, …
    std::optional<long long> unknowns;               ///< of the equations it owns
    std::optional<long long> entries_per_iteration;  ///< additions to the matrix
    double seconds = 0.0;
    long long calls = 0;
  };

  /// Registers an effect; `seconds` and `calls` of the entry usually start at zero. One without
  /// items that is registered again, by a later analysis, goes on.
  Id add(Entry entry);
  Id add(std::string name) { return add(Entry{std::move(name), {}, {}, {}, 0.0, 0}); }

  const Entry& entry(Id id) const;
  const std::vector<Entry>& entries() const { return entries_; }

  /// Sum of the times of all entries [s].
  double seconds() const;

  /// Sets times and calls to zero; what the entries contain stays.
  void reset_times();

  /// A text table: effect, items, unknowns, entries/iter, time, share.
  std::string report() const;

  /// Adds the time from construction to destruction to an entry. Scopes must end in the reverse
  /// order of their beginnings, which automatic variables do.
  class Scope {
   public:
    Scope(Ledger& ledger, Id id);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

    /// Goes on with another entry: what follows counts there. One look at the clock for two scopes
    /// in a row.
    void pass_to(Id id);

   private:
    Ledger& ledger_;
    Scope* outer_;
    Id id_;

    friend class Ledger;
  };

 private:
  /// Books the time since the last change of scope to the innermost open scope.
  void book();

  Now now_;
  std::vector<Entry> entries_;
  Scope* innermost_ = nullptr;
  Clock::time_point last_{};
};

}  // namespace culm
