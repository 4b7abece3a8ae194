#include <culm/base/findings.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace culm {
namespace {

struct FindingsTest : testing::Test {
  std::ostringstream said;
  Findings findings{Log(said, LogLevel::quiet)};
};

TEST_F(FindingsTest, EachIsSaidOnceAlsoWhenTheLogIsQuiet) {
  findings.begin("motion");
  findings.broken("certificate", "energy drifts", 2.0);
  findings.broken("certificate", "energy drifts", 3.0);
  findings.warn("turn", "elements turn far", 1.0);
  EXPECT_EQ(said.str(), "warning: energy drifts\nwarning: elements turn far\n");
  ASSERT_EQ(findings.all().size(), 2u);
  EXPECT_EQ(findings.all()[0].time, 2.0);
  EXPECT_EQ(findings.all()[0].analysis, "motion");
}

TEST_F(FindingsTest, AnotherAnalysisHasItsOwn) {
  findings.begin("a");
  findings.broken("path", "ended early", 0.5);
  findings.begin("b");
  findings.broken("path", "ended early", 0.5);
  EXPECT_EQ(findings.all().size(), 2u);
}

TEST_F(FindingsTest, TheVerdictCountsBrokenPromisesAndStrictlyWarningsToo) {
  EXPECT_EQ(findings.verdict(true), "");
  findings.begin("a");
  findings.warn("turn", "elements turn far", 1.0);
  EXPECT_EQ(findings.verdict(false), "");
  EXPECT_EQ(findings.verdict(true),
            "The run came to its end, but 1 of its promises does not hold: turn (a); see the "
            "warning above.");
  findings.broken("path", "ended early", 1.0);
  EXPECT_EQ(findings.verdict(true),
            "The run came to its end, but 2 of its promises do not hold: turn (a), path (a); see "
            "the warnings above.");
}

TEST_F(FindingsTest, ARunThatGoesOnSaysThemAgain) {
  findings.begin("a");
  findings.warn("turn", "elements turn far", 1.0);
  findings.broken("path", "ended early", 2.0);
  Snapshot snapshot;
  findings.save(snapshot);
  std::ostringstream again;
  Findings restored{Log(again, LogLevel::quiet)};
  restored.restore(Snapshot::decode(snapshot.encode()));
  EXPECT_EQ(again.str(), said.str());
  ASSERT_EQ(restored.all().size(), 2u);
  EXPECT_EQ(restored.all()[1].grade, Finding::Grade::broken);
  EXPECT_EQ(restored.all()[1].time, 2.0);
  EXPECT_EQ(restored.verdict(false), findings.verdict(false));
}

}  // namespace
}  // namespace culm
