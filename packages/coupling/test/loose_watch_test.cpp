#include <culm/coupling/loose_watch.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace culm::coupling {
namespace {

using Eigen::VectorXd;
using testing::HasSubstr;

// A mass that is driven, with a partner's mass whose force is one window late.
std::string first_warning(double structure, double partner, int windows, int* when = nullptr) {
  LooseWatch watch;
  VectorXd force = VectorXd::Zero(3);
  for (int n = 0; n < windows; ++n) {
    const VectorXd driven = VectorXd::LinSpaced(3, 1.0, 2.0) * (n < 2 ? 1.0 : 0.5);
    const VectorXd a = (driven + force) / structure;
    force = -partner * a;
    watch.add(force, a);
    const VectorXd probe = watch.probe();
    if (probe.size() > 0) watch.measure(probe, probe / structure);
    const std::string text = watch.warning();
    if (text.empty()) continue;
    if (when != nullptr) *when = n;
    return text;
  }
  return {};
}

TEST(LooseWatch, KnowsTheMassesBeforeLoadsGrow) {
  int when = 0;
  EXPECT_THAT(first_warning(2.0, 3.0, 100, &when), HasSubstr("a mass of 3 kg at each point, 1.5"));
  EXPECT_LE(when, 3);
  EXPECT_EQ(first_warning(2.0, 0.5, 9), "");
}

// Loads that flip and grow need no probe.
TEST(LooseWatch, SeesLoadsThatFlip) {
  LooseWatch watch;
  VectorXd force = VectorXd::Ones(3);
  std::string text;
  for (int n = 0; n < 12 && text.empty(); ++n) {
    force *= -1.1;
    watch.add(force, VectorXd::Zero(3));
    text = watch.warning();
  }
  EXPECT_THAT(text, HasSubstr("changed their sign in each of the last 10 windows"));
}

}  // namespace
}  // namespace culm::coupling
