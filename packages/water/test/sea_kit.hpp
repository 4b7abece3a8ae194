/// Seas as a deck makes them, for tests.
#pragma once

#include <culm/water/register_water.hpp>
#include <culm/water/sea.hpp>

#include <culm_kit/deck_list.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace culm::water::test {

inline Schema sea_schema(const std::string& type) {
  flow::FlowRegistry registry;
  register_seas(registry);
  return registry.variants().at(type);
}

inline std::vector<std::string> mistakes(const std::string& type, const kit::GivenValues& values) {
  return kit::mistakes_in(sea_schema(type), kit::deck_list(sea_schema(type), values, "sea"));
}

inline std::shared_ptr<const Sea> make_sea(const std::string& type,
                                           const kit::GivenValues& values) {
  flow::FlowRegistry registry;
  register_seas(registry);
  EXPECT_THAT(mistakes(type, values), testing::ElementsAre());
  model::Model model;
  const std::map<std::string, model::Amplitude> functions;
  InputIssues issues;
  model::BuildContext context{model, functions, issues};
  return std::dynamic_pointer_cast<const Sea>(
      registry.make(type, kit::deck_list(sea_schema(type), values, "sea"), context));
}

}  // namespace culm::water::test
