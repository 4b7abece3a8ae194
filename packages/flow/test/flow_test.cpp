#include <culm/flow/flow.hpp>

#include <culm_kit/deck_list.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace culm::flow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Flows : public testing::Test {
 protected:
  Flows() { register_flows(registry_); }

  SharedFlow make(const std::string& type, const kit::GivenValues& values) {
    const Schema schema = registry_.variants().at(type);
    const Options options = kit::deck_list(schema, values, "air");
    EXPECT_THAT(kit::mistakes_in(schema, options), ElementsAre());
    model::BuildContext context{model_, functions_, issues_};
    return registry_.make(type, options, context);
  }

  model::Model model_;
  std::map<std::string, model::Amplitude> functions_{
      {"Constant", model::Amplitude::constant()},
      {"growing", model::Amplitude::of_time([](double time) { return 2.0 * time; })},
      {"noise", model::Amplitude::of_step([](double, double) { return 1.0; })}};
  InputIssues issues_;

 private:
  FlowRegistry registry_;
};

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
