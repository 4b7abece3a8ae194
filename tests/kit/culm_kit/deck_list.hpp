/// Lists of the deck without a deck: what a type reads, made from its schema and a few values.
#pragma once

#include <culm/base/default_list.hpp>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace culm::kit {

using GivenValues = std::vector<std::pair<std::string, Value>>;

/// The options a deck would hand to a type: the given values, and the defaults of the schema.
inline Options deck_list(const Schema& schema, const GivenValues& given = {},
                         const std::string& name = "list") {
  Options options = default_list(schema, name, Where{"deck.xml", 1, name});
  for (const auto& [field, value] : given) {
    EXPECT_TRUE(schema.find_field(field)) << "the schema has no '" << field << "'";
    options.set(field, value);
  }
  return options;
}

/// All mistakes that the schema finds in a list: messages of its fields, then of its checks.
inline std::vector<std::string> mistakes_in(const Schema& schema, const Options& options) {
  std::vector<std::string> messages;
  for (const Options::Parameter& parameter : options.parameters()) {
    const Field* field = schema.find_field(parameter.name);
    if (!parameter.value && field->required()) messages.push_back(parameter.name + " is missing");
    if (!parameter.value) continue;
    for (auto& message : field->mistakes(*parameter.value)) messages.push_back(std::move(message));
  }
  if (!messages.empty()) return messages;
  InputIssues issues;
  for (const Schema::Check& check : schema.checks()) check(options, issues);
  for (const InputIssue& issue : issues.sorted()) messages.push_back(issue.message);
  return messages;
}

}  // namespace culm::kit
