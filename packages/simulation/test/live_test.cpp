#include <culm/base/error.hpp>

#include "live_deck.hpp"

#include <culm_kit/temporary_folder.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace culm::simulation {
namespace {

const std::string external = R"(<ParameterList name="push">
  <Parameter name="Type" value="External"/> <Parameter name="Node" value="beam/last"/>
</ParameterList>)";

const std::string constant = R"(<ParameterList name="force">
  <Parameter name="Type" value="Force"/> <Parameter name="Node" value="beam/last"/>
  <Parameter name="Force" value="{0.1, 0.5, -0.2}"/> <Parameter name="Function" value="Constant"/>
</ParameterList><ParameterList name="moment">
  <Parameter name="Type" value="Moment"/> <Parameter name="Node" value="beam/last"/>
  <Parameter name="Moment" value="{0.3, 0, 0.1}"/> <Parameter name="Function" value="Constant"/>
</ParameterList>)";

const std::vector<double> push = {0.1, 0.5, -0.2, 0.3, 0.0, 0.1};

TEST(LiveSimulation, ALoadThatIsSetActsAsThatOfADeck) {
  Live set(cantilever(external)), written(cantilever(constant));
  for (const char* name : {"bending", "motion"}) {
    analysis::Stepper& one = set.simulation.begin(name);
    analysis::Stepper& two = written.simulation.begin(name);
    while (!two.is_at_end()) {
      set.simulation.set_load("push", push);
      for (analysis::Stepper* stepper : {&one, &two}) {
        ASSERT_TRUE(stepper->attempt(stepper->proposal()).accepted);
        stepper->accept();
      }
    }
    const int end = set.simulation.nodes("beam/last").front();
    const Vec3 moved = set.simulation.position(end) - Vec3::UnitX();
    EXPECT_GT(moved.norm(), 0.01);
    EXPECT_LT((set.simulation.position(end) - written.simulation.position(end)).norm(), 1e-12);
    const std::vector<double> watched = set.simulation.quantities();
    ASSERT_EQ(watched.size(), set.simulation.quantity_columns().size());
    EXPECT_NEAR(watched[1], moved[1], 1e-15);
  }
}

// The cantilever with the force of its clamp in the history.
std::string watched_clamp() {
  std::string deck = cantilever(external);
  const std::string history = R"(<ParameterList name="History">)";
  deck.insert(deck.find(history) + history.size(), R"(<ParameterList name="foot">
      <Parameter name="Type" value="Reaction"/> <Parameter name="Node" value="beam/first"/>
    </ParameterList>)");
  return deck;
}

// Reactions belong to the last evaluation, which may be that of an attempt that was thrown away.
TEST(LiveSimulation, QuantitiesBetweenStepsAreThoseOfTheAcceptedOne) {
  Live live(watched_clamp());
  Simulation& s = live.simulation;
  s.set_load("push", push);
  analysis::Stepper& stepper = s.begin("motion");
  EXPECT_EQ(s.quantities().front(), 0.0) << "nothing has been solved yet";
  const auto step = [&](double factor) {
    std::vector<double> load = push;
    for (double& value : load) value *= factor;
    s.set_load("push", load);
    return stepper.attempt(stepper.proposal()).accepted;
  };
  ASSERT_TRUE(step(1.0));
  const std::vector<double> open = s.quantities();
  stepper.accept();
  const std::vector<double> accepted = s.quantities();
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_NEAR(open[i], accepted[i], 1e-12);
  Snapshot there(Snapshot::Use::memory);
  stepper.save(there);
  ASSERT_TRUE(step(2.0));
  EXPECT_GT(std::abs(s.quantities().front() - accepted.front()), 0.01);
  stepper.discard();
  EXPECT_EQ(s.quantities(), accepted);
  ASSERT_TRUE(step(2.0));
  stepper.fail();
  EXPECT_EQ(s.quantities(), accepted);
  ASSERT_TRUE(step(2.0));
  stepper.accept();
  EXPECT_NE(s.quantities(), accepted);
  stepper.restore(there);
  EXPECT_EQ(s.quantities(), accepted);
}

TEST(LiveSimulation, ABeginOfWhatIsNotThereLeavesWhatWasTakenUp) {
  Live live(cantilever(external));
  Simulation& s = live.simulation;
  EXPECT_EQ(s.stepper(), nullptr);
  analysis::Stepper& stepper = s.begin("motion");
  const long taken_up = s.taken_up();
  ASSERT_TRUE(stepper.attempt(stepper.proposal()).accepted);
  EXPECT_THROW(s.begin("modes"), UsageError);
  EXPECT_EQ(s.stepper(), &stepper);
  EXPECT_EQ(s.taken_up(), taken_up);
  stepper.accept();
  s.begin("bending");
  EXPECT_GT(s.taken_up(), taken_up);
}

// The numbers of each have names of their own.
TEST(LiveSimulation, AnAnalysisCanBeTakenUpAgainAndAgainWithResults) {
  const kit::TemporaryFolder folder;
  Live live(cantilever(external));
  Simulation& s = live.simulation;
  s.write_results(folder / "out");
  for (int time = 0; time < 4; ++time) {
    analysis::Stepper& stepper = s.begin("motion");
    ASSERT_TRUE(stepper.attempt(stepper.proposal()).accepted);
    stepper.accept();
  }
  EXPECT_NO_THROW(s.close_results());
  if (parallel::Comm().is_root()) {
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / "run.h5"));
  }
}

// A signal of the caller's own controller scales a load as a number in the deck does.
TEST(LiveSimulation, ASignalThatIsSetActsAsANumberOfTheDeck) {
  const auto load = [](const std::string& components, const std::string& function) {
    return R"(<ParameterList name="force">
      <Parameter name="Type" value="Force"/> <Parameter name="Node" value="beam/last"/>
      <Parameter name="Force" value=")" +
           components + R"("/> <Parameter name="Function" value=")" + function +
           R"("/></ParameterList>)";
  };
  Live set(
      cantilever(load("{0, 1, -0.4}", "command") +
                 R"(</ParameterList><ParameterList name="Signals"><ParameterList name="command">
                         <Parameter name="Type" value="External"/></ParameterList>)"));
  Live written(cantilever(load("{0, 0.5, -0.2}", "Constant")));
  EXPECT_THROW(set.simulation.set_signal("command", 0.5), UsageError);
  for (const char* name : {"bending", "motion"}) {
    analysis::Stepper& one = set.simulation.begin(name);
    analysis::Stepper& two = written.simulation.begin(name);
    EXPECT_THROW(set.simulation.set_signal("comand", 0.5), UsageError);
    EXPECT_THROW(set.simulation.set_signal("command", std::nan("")), NonFiniteError);
    while (!two.is_at_end()) {
      set.simulation.set_signal("command", 3.0);
      ASSERT_TRUE(one.attempt(one.proposal()).accepted);
      set.simulation.set_signal("command", 2.0);
      EXPECT_THROW(one.accept(), UsageError) << "it was attempted with another value";
      ASSERT_TRUE(one.attempt(one.proposal()).accepted);
      one.discard();
      set.simulation.set_signal("command", 0.5);
      for (analysis::Stepper* stepper : {&one, &two}) {
        ASSERT_TRUE(stepper->attempt(stepper->proposal()).accepted);
        stepper->accept();
      }
    }
    const int end = set.simulation.nodes("beam/last").front();
    EXPECT_GT(set.simulation.position(end)[1], 0.01);
    EXPECT_LT((set.simulation.position(end) - written.simulation.position(end)).norm(), 1e-12);
  }
}

// A force that changes from step to step has no potential: what it does is work, and the balance
// closes.
TEST(LiveSimulation, WorkOfALoadThatIsSetIsInTheBalance) {
  Live live(cantilever(external));
  live.simulation.begin("bending");
  analysis::Stepper& stepper = live.simulation.begin("motion");
  for (int i = 0; !stepper.is_at_end(); ++i) {
    live.simulation.set_load("push", {0.0, i % 3 - 1.0, 0.2 * i, 0.0, 0.1 * i, 0.0});
    ASSERT_TRUE(stepper.attempt(stepper.proposal()).accepted);
    stepper.accept();
  }
  for (const auto& [name, value] : stepper.finish().numbers) {
    if (name == "relative energy drift") {
      EXPECT_LT(value, 1e-11);
    }
  }
}

// A model without a file is that of the deck that says the same.
// Where other loads do not act, the next analysis has a model of its own.
TEST(LiveSimulation, ALoadThatIsSetActsInTheNextAnalysisToo) {
  const auto deck = [](const std::string& type, const char* force) {
    std::string text =
        cantilever(R"(<ParameterList name="push"><Parameter name="Type" value=")" + type +
                   R"("/><Parameter name="Node" value="beam/last"/>)" + force + R"(</ParameterList>
        <ParameterList name="other"><Parameter name="Type" value="Force"/>
        <Parameter name="Node" value="beam/last"/><Parameter name="Force" value="{0, 0.2, 0}"/>
        </ParameterList>)");
    const std::string dynamic = R"("Dynamic"/>)";
    return text.insert(text.find(dynamic) + dynamic.size(),
                       R"(<Parameter name="Inactive" value="{other}"/>)");
  };
  Live set(deck("External", "")),
      given(deck("Force", R"(<Parameter name="Force" value="{0, 0, 0.3}"/>
                             <Parameter name="Function" value="Constant"/>)"));
  set.simulation.set_load("push", {0.0, 0.0, 0.3, 0.0, 0.0, 0.0});
  for (Live* live : {&set, &given}) {
    for (const char* analysis : {"bending", "motion"}) {
      analysis::run(live->simulation.begin(analysis));
    }
  }
  const double there = given.simulation.quantities()[2];
  EXPECT_GT(std::abs(there), 1e-3);
  EXPECT_NEAR(set.simulation.quantities()[2], there, 1e-9);
}

TEST(LiveSimulation, ALoadThatDoesNotActInTheAnalysisIsNoUnknownOne) {
  std::string deck = cantilever(external);
  const std::string dynamic = R"("Dynamic"/>)";
  deck.insert(deck.find(dynamic) + dynamic.size(),
              R"(<Parameter name="Inactive" value="{push}"/>)");
  Live live(deck);
  live.simulation.set_load("push", push);
  live.simulation.begin("motion");
  try {
    live.simulation.set_load("push", push);
    ADD_FAILURE() << "it would not act";
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()), "load 'push' is 'Inactive' in 'motion'");
  }
}

TEST(LiveSimulation, AssignmentsMakeTheModelOfADeck) {
  Live written(cantilever(external));
  Simulation made = Simulation::make(
      {"Sections/bar/Type=Stiffness Values", "Sections/bar/EA=100", "Sections/bar/GA1=50",
       "Sections/bar/GA2=50", "Sections/bar/EI1=2", "Sections/bar/EI2=2", "Sections/bar/GIp=1",
       "Structures/beam/Type=Beam", "Structures/beam/Section=bar",
       "Structures/beam/Curve/Type=Line", "Structures/beam/Curve/From={0, 0, 0}",
       "Structures/beam/Curve/To={1, 0, 0}", "Structures/beam/Curve/Elements=" + std::to_string(3),
       "Constraints/clamp/Type=Rigid Support", "Constraints/clamp/Node=beam/first",
       "Loads/push/Type=External", "Loads/push/Node=beam/last", "Analyses/bending/Type=Static",
       "Analyses/bending/Steps=2"});
  for (Simulation* one : {&written.simulation, &made}) {
    analysis::Stepper& stepper = one->begin("bending");
    one->set_load("push", push);
    analysis::run(stepper);
  }
  const int end = made.nodes("beam/last").front();
  EXPECT_GT(made.position(end)[1], 0.01);
  EXPECT_EQ(made.position(end), written.simulation.position(end));
  EXPECT_THROW(Simulation::make({"Structures/beam/Type=Baem"}), InputError);
}

// What a snapshot does not belong to stays as it is.
TEST(LiveSimulation, RefusesSnapshotsOfOtherAnalysesAndModels) {
  Live live(cantilever(external));
  analysis::Stepper& bending = live.simulation.begin("bending");
  Snapshot bent(Snapshot::Use::memory);
  bending.save(bent);
  analysis::Stepper& motion = live.simulation.begin("motion");
  const model::Coordinates before = motion.state().next;
  EXPECT_THROW(motion.restore(bent), UsageError);
  EXPECT_THROW(motion.restore(Snapshot(Snapshot::Use::memory)), UsageError);
  EXPECT_TRUE(std::ranges::equal(motion.state().next, before));
  Snapshot moved(Snapshot::Use::memory);
  motion.save(moved);
  std::string text = cantilever(external);
  const std::string coarse = R"("Elements" value="3")";
  text.replace(text.find(coarse), coarse.size(), R"("Elements" value="4")");
  Live finer(text);
  EXPECT_THROW(finer.simulation.begin("motion").restore(moved), UsageError);
  Live equal(cantilever(external));
  equal.simulation.begin("motion").restore(moved);
  EXPECT_TRUE(motion.attempt(motion.proposal()).accepted);
}

TEST(LiveSimulation, RefusesWhatItDoesNotKnow) {
  Live live(cantilever(external));
  EXPECT_THROW(live.simulation.begin("modes"), UsageError);
  analysis::Stepper& stepper = live.simulation.begin();
  EXPECT_THROW(live.simulation.set_load("pusch", push), UsageError);
  EXPECT_THROW(live.simulation.set_load("push", {1.0, 2.0}), UsageError);
  std::vector<double> broken = push;
  broken[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(live.simulation.set_load("push", broken), NonFiniteError);
  EXPECT_THROW(live.simulation.nodes("beam/lst"), UsageError);
  EXPECT_THROW(stepper.accept(), UsageError);
  EXPECT_THROW(stepper.fail(), UsageError);
  stepper.attempt(stepper.proposal());
  Snapshot snapshot(Snapshot::Use::memory);
  EXPECT_THROW(stepper.save(snapshot), UsageError);
  analysis::Stepper& motion = live.simulation.begin("motion");
  EXPECT_THROW(motion.attempt(0.0), UsageError);
  EXPECT_THROW(motion.attempt(std::numeric_limits<double>::infinity()), NonFiniteError);
  EXPECT_TRUE(motion.attempt(motion.proposal()).accepted);
  motion.finish();
  EXPECT_THROW(motion.attempt(motion.proposal()), UsageError);
}

}  // namespace
}  // namespace culm::simulation
