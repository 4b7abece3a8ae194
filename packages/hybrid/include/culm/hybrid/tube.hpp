/// The structure type "Tube" of the deck: one geometry, a beam or a shell.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/beam/register_beam.hpp>
#include <culm/shell/shell_structure.hpp>

namespace culm::hybrid {

/// Where beams and shells are added to.
struct HybridContext {
  beam::StructureContext& beams;
  shell::ShellContext& shells;
};

/// Types of the deck's list "Structures" that become beams or shells. @see Registry
using HybridRegistry = Registry<void, HybridContext&>;

/// Adds "Tube": a straight circular tube of an isotropic material. As a shell it has two more
/// structures, "NAME first" and "NAME last", nodes with directors that its ends follow; in both
/// models "NAME/first" and "NAME/last" are the nodes to hold, load and watch.
void register_hybrids(HybridRegistry& registry);

}  // namespace culm::hybrid
