#include <culm/base/ledger.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

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

struct Turns {
  Ledger ledger = Ledger(now);
  std::vector<Ledger::Id> effects = {ledger.add("Beam"), ledger.add("Gravity")};
  // an effect comes twice, as two batches of one kind do
  std::optional<Ledger::Round> round = std::optional<Ledger::Round>(
      std::in_place, ledger, std::vector{effects[0], effects[1], effects[0]});

  void lap(double beam, double gravity, double more_of_the_beam) {
    Ledger::Round::Lap lap(*round);
    lap.pass_to(0);
    wait(beam);
    lap.pass_to(1);
    wait(gravity);
    lap.pass_to(2);
    wait(more_of_the_beam);
  }
  double beam() const { return ledger.entry(effects[0]).seconds; }
  double gravity() const { return ledger.entry(effects[1]).seconds; }
};

TEST(Ledger, LongLapsAreTimedEffectByEffect) {
  Turns turns;
  for (int i = 0; i < 100; ++i) turns.lap(1.0, i, 3.0);
  EXPECT_EQ(turns.beam(), 400.0);
  EXPECT_EQ(turns.gravity(), 4950.0);
  EXPECT_EQ(turns.ledger.entry(turns.effects[0]).calls, 200);
  EXPECT_EQ(turns.ledger.entry(turns.effects[1]).calls, 100);
}

// Nothing is lost; a few laps are looked at closely, and who is slow now and then has its part.
TEST(Ledger, ShortLapsAreSharedOut) {
  Turns turns;
  constexpr int laps = 100000;
  double gravity = 0.0;
  for (int i = 0; i < laps; ++i) {
    const double now_and_then = i % 20 == 0 ? 20e-7 : 1e-7;
    gravity += now_and_then;
    turns.lap(2e-7, now_and_then, 1e-7);
  }
  turns.round.reset();
  EXPECT_NEAR(turns.beam() + turns.gravity(), 3e-7 * laps + gravity, 1e-9 * laps * 1e-7);
  EXPECT_NEAR(turns.gravity() / gravity, 1.0, 0.05);
  EXPECT_EQ(turns.ledger.entry(turns.effects[0]).calls, 2 * laps);
  EXPECT_EQ(turns.ledger.entry(turns.effects[1]).calls, laps);
}

TEST(Ledger, ALapOfNothingTakesNothing) {
  Ledger ledger(now);
  Ledger::Round round(ledger, {});
  { const Ledger::Round::Lap lap(round); }
  EXPECT_EQ(ledger.seconds(), 0.0);
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
