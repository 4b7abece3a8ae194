/// Flows as a deck makes them, for tests.
#pragma once

#include <culm/flow/flow.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace culm::flow {

/// Its gradient against central differences, which nearly linear winds leave only rounding.
inline void expect_gradient(const Flow& flow, const Vec3& place, double time,
                            const Mat3& directions = Mat3::Identity()) {
  constexpr double h = 1e-4;
  const Mat3 gradient = flow.gradient(place, time);
  for (int i = 0; i < 3; ++i) {
    const Vec3 step = h * directions.col(i);
    const Vec3 found =
        (flow.velocity(place + step, time) - flow.velocity(place - step, time)) / (2.0 * h);
    EXPECT_LT((gradient * directions.col(i) - found).norm(), 1e-7)
        << i << ": " << found.transpose();
  }
  EXPECT_GT(gradient.norm(), 1e-4);
}

class FlowTest : public testing::Test {
 protected:
  FlowTest() { register_flows(registry_); }

  Schema schema(const std::string& type) const { return registry_.variants().at(type); }
  std::vector<std::string> mistakes(const std::string& type, const kit::GivenValues& values) const {
    return kit::mistakes_in(schema(type), kit::deck_list(schema(type), values, "wind"));
  }
  SharedFlow make(const std::string& type, const kit::GivenValues& values) {
    return make(type, kit::deck_list(schema(type), values, "wind"));
  }
  SharedFlow make(const std::string& type, const Options& options) {
    EXPECT_THAT(kit::mistakes_in(schema(type), options), testing::ElementsAre());
    model::BuildContext context{model_, functions_, issues_};
    return registry_.make(type, options, context);
  }

  kit::TemporaryFolder folder_;
  model::Model model_;
  std::map<std::string, model::Amplitude> functions_{
      {"Constant", model::Amplitude::constant()},
      {"growing", model::Amplitude::of_time([](double time) { return 2.0 * time; })},
      {"noise", model::Amplitude::of_step([](double, double) { return 1.0; })}};
  InputIssues issues_;

 private:
  FlowRegistry registry_;
};

}  // namespace culm::flow
