#pragma once

#include <culm/base/cycle_clock.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
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

  /// Effects that work in the same order again and again. Where they do that so fast that looks at
  /// the clock would be a notable part of it, one lap in eight is timed effect by effect, by
  /// chance. The others are timed as a whole, of which effects are given what they had of all laps
  /// that were: nothing is lost, and who is slow now and then has its part.
  class Round {
   public:
    /// @param ledger  which must live longer @param effects  in their order; one may come more than
    /// once
    Round(Ledger& ledger, std::vector<Id> effects);
    ~Round() { share_out(); }
    Round(const Round&) = delete;
    Round& operator=(const Round&) = delete;

    /// Once through, to its destruction.
    class Lap {
     public:
      explicit Lap(Round& round);
      ~Lap();
      Lap(const Lap&) = delete;
      Lap& operator=(const Lap&) = delete;
      /// Begins the effect at this place of their order, the next one.
      void pass_to(std::size_t place);

     private:
      Round& round_;
      bool is_timed_;  ///< effect by effect
      std::optional<Scope> scope_;
    };

   private:
    bool is_to_be_timed();
    void learn();
    void put_aside();
    void share_out();

    Ledger& ledger_;
    std::vector<Id> order_;
    std::vector<Id> effects_;     ///< each once
    std::vector<double> before_;  ///< seconds of each, or of the first, when the lap began
    std::vector<double> timed_;   ///< seconds of each in all laps that were timed
    double all_timed_ = 0.0;      ///< their sum
    double laps_timed_ = 0.0;
    double pending_ = 0.0;  ///< seconds of other laps that are not shared out yet
    std::uint32_t chance_ = 0;
  };

 private:
  double& seconds_of(Id id) { return entries_[static_cast<std::size_t>(id)].seconds; }

  /// Books the time since the last change of scope to the innermost open scope.
  void book();

  Now now_;
  std::vector<Entry> entries_;
  Scope* innermost_ = nullptr;
  Clock::time_point last_{};
};

}  // namespace culm
