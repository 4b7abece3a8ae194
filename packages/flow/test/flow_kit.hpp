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
