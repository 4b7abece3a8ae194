#include <culm/base/ledger.hpp>

#include <gtest/gtest.h>

#include <string>

namespace culm {
namespace {

void wait(double seconds) {
  const auto begin = Ledger::Clock::now();
  while (std::chrono::duration<double>(Ledger::Clock::now() - begin).count() < seconds) {
  }
}

TEST(Ledger, AScopeBooksTimeAndACall) {
  Ledger ledger;
  const Ledger::Id id = ledger.add("Gravity");
  {
    const Ledger::Scope scope(ledger, id);
    wait(2e-3);
  }
  EXPECT_EQ(ledger.entry(id).calls, 1);
  EXPECT_GE(ledger.entry(id).seconds, 2e-3);
}

TEST(Ledger, TimeIsCountedOnceWhenScopesNest) {
  Ledger ledger;
  const Ledger::Id outer = ledger.add("Newton");
  const Ledger::Id inner = ledger.add("Linear solve");
  const auto begin = Ledger::Clock::now();
  {
    const Ledger::Scope outer_scope(ledger, outer);
    {
      const Ledger::Scope inner_scope(ledger, inner);
      wait(5e-3);
    }
    wait(1e-3);
  }
  const double elapsed = std::chrono::duration<double>(Ledger::Clock::now() - begin).count();
  EXPECT_GE(ledger.entry(inner).seconds, 5e-3);
  EXPECT_GE(ledger.entry(outer).seconds, 1e-3);
  EXPECT_LE(ledger.seconds(), elapsed);
}

TEST(Ledger, AScopePassesToAnotherEntry) {
  Ledger ledger;
  const Ledger::Id first = ledger.add("Gravity");
  const Ledger::Id second = ledger.add("Force");
  {
    Ledger::Scope scope(ledger, first);
    wait(2e-3);
    scope.pass_to(second);
    wait(5e-3);
  }
  EXPECT_EQ(ledger.entry(first).calls, 1);
  EXPECT_EQ(ledger.entry(second).calls, 1);
  EXPECT_GE(ledger.entry(first).seconds, 2e-3);
  EXPECT_LT(ledger.entry(first).seconds, ledger.entry(second).seconds);
  EXPECT_GE(ledger.entry(second).seconds, 5e-3);
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
  Ledger ledger;
  const Ledger::Id id = ledger.add("Gravity");
  { const Ledger::Scope scope(ledger, id); }
  wait(5e-3);
  { const Ledger::Scope scope(ledger, id); }
  EXPECT_LT(ledger.entry(id).seconds, 4e-3);
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
