/// What this package offers to the deck.
#pragma once

#include <culm/base/log.hpp>
#include <culm/base/options.hpp>
#include <culm/base/registry.hpp>
#include <culm/material/section.hpp>
#include <culm/model/imperfection.hpp>
#include <culm/model/model.hpp>
#include <culm/model/size_budget.hpp>

#include <map>
#include <string>

namespace culm::beam {

/// Where structures are added to, what they are made of, and where mistakes of the deck go.
struct StructureContext {
  model::Model& model;
  const std::map<std::string, material::Section>& sections;  ///< list "Sections" of the deck
  InputIssues& issues;
  const Log& log;
  int refinement = 1;  ///< elements for each one of the deck, along each of its directions
  const model::Imperfection* imperfection = nullptr;  ///< none if null
  model::SizeBudget* budget = nullptr;                ///< any size if null
};

/// Types of the deck's list "Structures". Each adds one structure under the name of its list.
/// @see Registry
using StructureRegistry = Registry<void, StructureContext&>;

/// Adds all structure types of this package.
void register_structures(StructureRegistry& registry);

}  // namespace culm::beam
