#include <culm/base/error.hpp>

#include <gtest/gtest.h>

namespace culm {
namespace {

TEST(Error, ExitCodesAreThePublishedOnes) {
  EXPECT_EQ(InternalError("x").exit_code(), 1);
  EXPECT_EQ(UsageError("x").exit_code(), 2);
  EXPECT_EQ(InputError(Where{}, "x").exit_code(), 3);
  EXPECT_EQ(NumericalError("x").exit_code(), 4);
  EXPECT_EQ(NonFiniteError("x").exit_code(), 5);
  EXPECT_EQ(FileError("x").exit_code(), 6);
}

TEST(Error, FileErrorNamesTheFile) {
  EXPECT_STREQ(FileError("a.xml", "cannot be read").what(), "a.xml: cannot be read");
}

TEST(Error, InternalErrorSaysWhereAndAsksForAReport) {
  const std::string text = InternalError("slot is negative").what();
  EXPECT_EQ(text.find("packages/base/test/error_test.cpp:"), 0U) << text;
  EXPECT_NE(text.find("slot is negative – this is a bug in culm, please report it"),
            std::string::npos)
      << text;
}

TEST(Error, InternalCheckThrowsInEveryBuild) {
  EXPECT_NO_THROW(internal_check(true, "fine"));
  EXPECT_THROW(internal_check(false, "not fine"), InternalError);
}

TEST(Error, AssertThrowsInDebugBuildsOnly) {
  [[maybe_unused]] const int count = 2;
#ifdef NDEBUG
  EXPECT_NO_THROW(CULM_ASSERT(count == 3));
#else
  EXPECT_THROW(CULM_ASSERT(count == 3), InternalError);
#endif
  EXPECT_NO_THROW(CULM_ASSERT(count == 2));
}

TEST(Issue, PrintsFileLinePathAndMessage) {
  const InputIssue issue{{"inputs/body/heavy_top.xml", 12, "Structures / top / Mass"},
                         "must be > 0 kg, got -15"};
  EXPECT_EQ(to_string(issue),
            "inputs/body/heavy_top.xml:12: Structures / top / Mass: must be > 0 kg, got -15");
}

TEST(Issue, LeavesOutWhatThereIsNot) {
  EXPECT_EQ(to_string(InputIssue{{"command line", 0, "Analysis"}, "wrong"}),
            "command line: Analysis: wrong");
  EXPECT_EQ(to_string(InputIssue{{"a.xml", 3, ""}, "wrong"}), "a.xml:3: wrong");
  EXPECT_EQ(to_string(InputIssue{{}, "wrong"}), "wrong");
}

TEST(Issue, PathsGrowFromTheRoot) {
  EXPECT_EQ(join_path("", "Structures"), "Structures");
  EXPECT_EQ(join_path("Structures", "beam"), "Structures / beam");
}

TEST(InputIssues, NoIssueThrowsNothing) { EXPECT_NO_THROW(InputIssues().throw_if_any()); }

TEST(InputIssues, AllIssuesAreThrownTogetherInTheOrderOfTheFile) {
  InputIssues issues;
  issues.add({"a.xml", 9, "C"}, "third");
  issues.add({"b.xml", 1, "D"}, "fourth");
  issues.add({"a.xml", 2, "A"}, "first");
  issues.add({"a.xml", 2, "B"}, "second");
  try {
    issues.throw_if_any();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a.xml:2: A: first\na.xml:2: B: second\na.xml:9: C: third\nb.xml:1: D: fourth");
    EXPECT_EQ(error.issues().size(), 4U);
  }
}

TEST(InputIssues, AMessageShowsTheFirstHundredAndCountsTheRest) {
  InputIssues issues;
  for (int line = 300; line > 0; --line) issues.add({"a.xml", line, ""}, "wrong");
  try {
    issues.throw_if_any();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("a.xml:1: wrong\na.xml:2: wrong\n"), 0U);
    EXPECT_EQ(text.substr(text.find("a.xml:100:")), "a.xml:100: wrong\nand 200 more mistakes");
    EXPECT_EQ(error.issues().size(), 300U);
  }
}

TEST(Issue, LongNamesAndValuesAreCut) {
  const InputIssue issue{{"a.xml", 1, std::string(1000000, 'n')}, std::string(1000000, 'v')};
  EXPECT_EQ(to_string(issue), "a.xml:1: " + std::string(300, 'n') + "… (999700 more bytes): " +
                                  std::string(2000, 'v') + "… (998000 more bytes)");
}

TEST(Nearest, OfManyCandidatesTheFirstAreListed) {
  std::vector<std::string> names;
  for (int i = 0; i < 10000; ++i) names.push_back("n" + std::to_string(1000 * i));
  const std::string text = did_you_mean("something else", names);
  EXPECT_EQ(text.substr(0, 19), " (allowed: n0, n100");
  EXPECT_EQ(text.substr(text.size() - 23), ", n59000 and 9940 more)");
}

TEST(Nearest, ASwapOfNeighboursIsOneEdit) {
  EXPECT_EQ(nearest_name("Interia", {"Inertia", "Mass"}), "Inertia");
}

TEST(Nearest, CaseDoesNotMatter) {
  EXPECT_EQ(nearest_name("outer radius", {"Inner Radius", "Outer Radius"}), "Outer Radius");
}

TEST(Nearest, AnotherNameIsNotNear) {
  EXPECT_EQ(nearest_name("Colour", {"Mass", "Inertia"}), "");
  EXPECT_EQ(nearest_name("E", {"G", "A"}), "");
  EXPECT_EQ(nearest_name("", {"A"}), "");
  EXPECT_EQ(nearest_name(std::string(1000000, 'x'), {"A"}), "");
}

TEST(Nearest, SuggestsTheNearestOrListsAll) {
  EXPECT_EQ(did_you_mean("Mas", {"Mass", "Inertia"}), " – did you mean 'Mass'?");
  EXPECT_EQ(did_you_mean("Colour", {"Mass", "Inertia"}), " (allowed: Mass, Inertia)");
  EXPECT_EQ(did_you_mean("Colour", {}), "");
}

}  // namespace
}  // namespace culm
