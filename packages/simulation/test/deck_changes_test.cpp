#include <culm/simulation/deck_changes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace culm::simulation {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Options dynamic(const std::string& name, double end) {
  Options analysis(name, {"d.xml", 9, "Analyses / " + name});
  analysis.set("Type", std::string("Dynamic")).set("End Time", end).set("Step", 0.1);
  analysis.set("Scheme", std::string("Conserving"));
  Options newton("Newton", {"d.xml", 10, "Analyses / " + name + " / Newton"});
  newton.set("Force Tolerance", 1e-10);
  analysis.add_list(newton);
  return analysis;
}

Options deck(double mass = 1.0,
             const std::vector<Options>& analyses = {dynamic("a", 1.0), dynamic("b", 2.0)}) {
  Options root("culm", {"d.xml", 1, ""});
  root.set("Title", std::string("t"));
  Options body("hub", {"d.xml", 3, "Structures / hub"});
  body.set("Type", std::string("Rigid Body"));
  body.set("Mass", mass, true, {"d.xml", 4, "Structures / hub / Mass"});
  Options structures("Structures", {"d.xml", 2, "Structures"});
  structures.declare_entries().add_entry(body);
  Options list("Analyses", {"d.xml", 8, "Analyses"});
  list.declare_entries();
  for (const Options& analysis : analyses) list.add_entry(analysis);
  Options history("History", {"d.xml", 12, "Output / History"});
  Options output("Output", {"d.xml", 11, "Output"});
  output.set("Every", 1).add_list(history.declare_entries());
  output.add_list(Options("Shell", {"d.xml", 13, "Output / Shell"}));
  root.add_list(structures).add_list(list).add_list(output);
  return root;
}

std::vector<std::string> changes(const Options& before, const Options& now,
                                 std::size_t analysis = 1, double time = 1.5) {
  std::vector<std::string> texts;
  for (const InputIssue& issue :
       find_forbidden_changes(before, now, analysis, time, {"Path"}).sorted()) {
    texts.push_back(to_string(issue));
  }
  return texts;
}

TEST(DeckChanges, WhatDoesNotChangeTheModelIsFree) {
  Options b = dynamic("b", 7.0);
  b.set("Step", 0.2);
  const Options now = deck(1.0, {dynamic("a", 1.0), b, dynamic("c", 8.0)});
  EXPECT_THAT(changes(deck(), now), IsEmpty());
  EXPECT_THAT(changes(deck(), deck()), IsEmpty());
  // the second analysis had not begun
  EXPECT_THAT(changes(deck(), deck(1.0, {dynamic("a", 1.0)}), 0, 0.5), IsEmpty());
}

TEST(DeckChanges, AnotherModelIsNamed) {
  EXPECT_THAT(
      changes(deck(), deck(2.0)),
      ElementsAre("d.xml:4: Structures / hub / Mass: 'Mass' was 1 in the run and is 2 now"));
}

TEST(DeckChanges, AnotherPastIsNamed) {
  EXPECT_THAT(changes(deck(), deck(1.0, {dynamic("a", 1.1), dynamic("b", 2.0)})),
              ElementsAre("d.xml:9: Analyses / a: 'End Time' was 1 in the run and is 1.1 now"));
  EXPECT_THAT(changes(deck(), deck(1.0, {dynamic("b", 2.0), dynamic("a", 1.0)})),
              ElementsAre("d.xml:8: Analyses: analysis 1 was 'a' in the run and is 'b' now"));
  EXPECT_THAT(changes(deck(), deck(1.0, {dynamic("a", 1.0)})),
              ElementsAre("d.xml:8: Analyses: analysis 2 was 'b' in the run and is missing now"));
  EXPECT_THAT(changes(deck(), deck(1.0, {dynamic("a", 1.0), dynamic("b", 1.25)})),
              ElementsAre("d.xml:9: Analyses / b: the run has reached 1.5, got 1.25"));
  Options other = dynamic("b", 2.0);
  other.set("Scheme", std::string("Generalised Alpha"));
  EXPECT_THAT(changes(deck(), deck(1.0, {dynamic("a", 1.0), other})),
              ElementsAre("d.xml:9: Analyses / b: 'Scheme' was Conserving in the run and is "
                          "Generalised Alpha now"));
}

}  // namespace
}  // namespace culm::simulation
