#include "flow_kit.hpp"

#include <string>
#include <vector>

namespace culm::flow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Flows = FlowTest;

TEST_F(Flows, UniformIsTheSameEverywhereAndFollowsAFunction) {
  const SharedFlow air = make("Uniform", {{"Density", 1.225},
                                          {"Velocity", std::vector{1.0, -2.0, 3.0}},
                                          {"Function", std::string("growing")}});
  EXPECT_EQ(air->density(), 1.225);
  EXPECT_EQ(air->velocity(Vec3(4.0, 5.0, 6.0), 1.5), Vec3(3.0, -6.0, 9.0));
}

TEST_F(Flows, AFunctionThatHasNoValueAtATimeIsRefused) {
  make("Uniform", {{"Density", 1.0},
                   {"Velocity", std::vector{1.0, 0.0, 0.0}},
                   {"Function", std::string("noise")}});
  EXPECT_THROW(issues_.throw_if_any(), InputError);
}

}  // namespace
}  // namespace culm::flow
