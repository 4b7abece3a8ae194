#include <culm/base/ledger.hpp>

#include <gtest/gtest.h>

#include <chrono>

namespace culm {
namespace {

// Stands still but for what the tests let pass: they depend on no clock.
Ledger::Clock::time_point hour_hand;

Ledger::Clock::time_point now() { return hour_hand; }

void wait(double seconds) {
  hour_hand +=
      std::chrono::duration_cast<Ledger::Clock::duration>(std::chrono::duration<double>(seconds));
}

TEST(Ledger, AScopeBooksTimeAndACall) {
  Ledger ledger(now);
  const Ledger::Id id = ledger.add("Gravity");
  wait(4.0);
  {
    const Ledger::Scope scope(ledger, id);
    wait(2.0);
  }
  EXPECT_EQ(ledger.entry(id).calls, 1);
  EXPECT_EQ(ledger.entry(id).seconds, 2.0);
}

TEST(Ledger, TheClockOfARunIsTheOneOfTheSystem) {
  Ledger ledger;
  const Ledger::Id id = ledger.add("Gravity");
  const auto begin = Ledger::Clock::now();
  { const Ledger::Scope scope(ledger, id); }
  const std::chrono::duration<double> around = Ledger::Clock::now() - begin;
  EXPECT_GE(ledger.entry(id).seconds, 0.0);
  EXPECT_LE(ledger.entry(id).seconds, around.count());
}

TEST(Ledger, TimeIsCountedOnceWhenScopesNest) {
  Ledger ledger(now);
  const Ledger::Id outer = ledger.add("Newton");
  const Ledger::Id inner = ledger.add("Linear solve");
  {
    const Ledger::Scope outer_scope(ledger, outer);
    wait(0.25);
    {
      const Ledger::Scope inner_scope(ledger, inner);
      wait(5.0);
    }
    wait(1.0);
  }
  EXPECT_EQ(ledger.entry(inner).seconds, 5.0);
  EXPECT_EQ(ledger.entry(outer).seconds, 1.25);
  EXPECT_EQ(ledger.seconds(), 6.25);
}

TEST(Ledger, AScopePassesToAnotherEntry) {
  Ledger ledger(now);
  const Ledger::Id first = ledger.add("Gravity");
  const Ledger::Id second = ledger.add("Force");
  {
    Ledger::Scope scope(ledger, first);
    wait(2.0);
    scope.pass_to(second);
    wait(5.0);
  }
  EXPECT_EQ(ledger.entry(first).calls, 1);
  EXPECT_EQ(ledger.entry(second).calls, 1);
  EXPECT_EQ(ledger.entry(first).seconds, 2.0);
  EXPECT_EQ(ledger.entry(second).seconds, 5.0);
}

TEST(Ledger, ScopesMayRegisterEffects) {
  Ledger ledger;
  const Ledger::Id first = ledger.add("first");
  {
    const Ledger::Scope scope(ledger, first);
    for (int i = 0; i < 100; ++i) ledger.add("more");
  }
  EXPECT_EQ(ledger.entry(first).calls, 1);
}

TEST(Ledger, TimeOutsideScopesBelongsToNobody) {
  Ledger ledger(now);
  const Ledger::Id id = ledger.add("Gravity");
  { const Ledger::Scope scope(ledger, id); }
  wait(5.0);
  { const Ledger::Scope scope(ledger, id); }
  EXPECT_EQ(ledger.entry(id).seconds, 0.0);
  EXPECT_EQ(ledger.entry(id).calls, 2);
}

TEST(Ledger, ReportsWhatEachEffectContainsAndItsShare) {
  Ledger ledger;
  ledger.add({"Shell4, laminate", 1200, 8400, 1153200, 41.3, 10});
  ledger.add({"Linear solve, KLU2", {}, 17297, {}, 118.9, 10});
  ledger.add({"Größe", {}, {}, {}, 0.0, 0});
  EXPECT_EQ(ledger.report(),
            "effect               items   unknowns   entries/iter     time   share\n"
            "Shell4, laminate      1200       8400        1153200   41.3 s    26 %\n"
            "Linear solve, KLU2       –      17297              –    119 s    74 %\n"
            "Größe                    –          –              –   0.0 µs     0 %\n");
}

TEST(Ledger, ResetKeepsWhatEffectsContain) {
  Ledger ledger;
  const Ledger::Id id = ledger.add({"Beam", 8, 54, 1152, 1.0, 3});
  ledger.reset_times();
  EXPECT_EQ(ledger.entry(id).seconds, 0.0);
  EXPECT_EQ(ledger.entry(id).calls, 0);
  EXPECT_EQ(ledger.entry(id).items, 8);
}

}  // namespace
}  // namespace culm
