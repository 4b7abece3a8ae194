/// The structure type "Shell" of the deck.
#pragma once

#include <culm/base/log.hpp>
#include <culm/base/registry.hpp>
#include <culm/material/material.hpp>
#include <culm/model/imperfection.hpp>
#include <culm/model/model.hpp>
#include <culm/model/size_budget.hpp>

#include <map>
#include <string>

namespace culm::shell {

/// Where shells are added to, what they are made of, and where mistakes of the deck go.
struct ShellContext {
  model::Model& model;
  const std::map<std::string, material::Material>& materials;  ///< list "Materials" of the deck
  const Log& log;
  int refinement = 1;  ///< elements for each one of the deck, along each of its directions
  const model::Imperfection* imperfection = nullptr;  ///< none if null
  model::SizeBudget* budget = nullptr;                ///< any size if null
};

/// Types of the deck's list "Structures" that are made of materials. @see Registry
using ShellRegistry = Registry<void, ShellContext&>;

/// Adds "Shell": its layup, kind of element, and the list `Mesh` (see mesh_types.hpp). The
/// structure has node sets for the edges of the mesh, for their common nodes ("u0 v1"), and "all".
/// Throws InputError.
void register_shells(ShellRegistry& registry);

}  // namespace culm::shell
