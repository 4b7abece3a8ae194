#include <culm/base/log.hpp>
#include <culm/base/text.hpp>
#include <culm/base/value.hpp>
#include <culm/base/version.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace culm {
namespace {

std::string everything(LogLevel level, int rank) {
  std::ostringstream stream;
  const Log log(stream, level, rank);
  log.debug("slots found");
  log.info("step 1");
  log.warning("no load");
  log.error("no convergence");
  return stream.str();
}

TEST(Log, PrintsMessagesFromItsLevelOn) {
  EXPECT_EQ(everything(LogLevel::debug, 0),
            "debug: slots found\nstep 1\nwarning: no load\nerror: no convergence\n");
  EXPECT_EQ(everything(LogLevel::info, 0), "step 1\nwarning: no load\nerror: no convergence\n");
}

TEST(Log, QuietKeepsWarningsAndErrors) {
  EXPECT_EQ(everything(LogLevel::quiet, 0), "warning: no load\nerror: no convergence\n");
}

TEST(Log, OtherRanksAreSilent) { EXPECT_EQ(everything(LogLevel::debug, 1), ""); }

TEST(Log, BracesInAMessageAreText) {
  std::ostringstream stream;
  Log(stream, LogLevel::info).info("{0} 100 %");
  EXPECT_EQ(stream.str(), "{0} 100 %\n");
}

TEST(Text, NumbersReadBackExactly) {
  for (const double value : {0.1, -15.0, 1.0 / 3.0, 1e-300, 6.02e23}) {
    EXPECT_EQ(std::stod(format_number(value)), value);
  }
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(-15.0), "-15");
}

TEST(Text, TrimTakesBlanksFromBothEnds) {
  EXPECT_EQ(trim(" \t a b\n"), "a b");
  EXPECT_EQ(trim(" \n "), "");
}

TEST(Value, PrintsAsTheDeckWritesIt) {
  EXPECT_EQ(to_string(Value(0.5)), "0.5");
  EXPECT_EQ(to_string(Value(true)), "true");
  EXPECT_EQ(to_string(Value(std::vector{1.0, 2.5})), "{1, 2.5}");
  EXPECT_EQ(to_string(Value(std::vector<std::string>{"a", "b"})), "{a, b}");
}

TEST(Version, IsThreeNumbers) { EXPECT_EQ(version, "0.1.0"); }

}  // namespace
}  // namespace culm
