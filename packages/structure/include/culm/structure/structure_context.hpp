/// What all makers of structures share: where they add to, and what they are given.
#pragma once

#include <culm/base/log.hpp>
#include <culm/base/options.hpp>
#include <culm/base/registry.hpp>
#include <culm/material/material.hpp>
#include <culm/material/section.hpp>
#include <culm/model/imperfection.hpp>
#include <culm/model/model.hpp>
#include <culm/model/size_budget.hpp>

#include <map>
#include <string>

namespace culm::structure {

/// Where structures are added to, what they may be made of, and where mistakes of the deck go.
struct StructureContext {
  model::Model& model;
  const std::map<std::string, material::Section>& sections;    ///< list "Sections" of the deck
  const std::map<std::string, material::Material>& materials;  ///< list "Materials"
  InputIssues& issues;
  const Log& log;
  int refinement = 1;  ///< elements for each one of the deck, along each of its directions
  const model::Imperfection* imperfection = nullptr;  ///< none if null
  model::SizeBudget* budget = nullptr;                ///< any size if null
};

/// Types of the deck's list "Structures". Each adds one structure under the name of its list, and
/// may add others that belong to it. @see Registry
using StructureRegistry = Registry<void, StructureContext&>;

}  // namespace culm::structure
