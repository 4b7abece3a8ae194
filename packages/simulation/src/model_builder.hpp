/// From the lists of a deck to a model.
#pragma once

#include <culm/base/log.hpp>
#include <culm/model/size_budget.hpp>
#include <culm/port/port.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/result_files.hpp>

#include "imperfections.hpp"
#include "phase.hpp"

#include <memory>
#include <vector>

namespace culm::simulation {

/// What belongs to a model beside it.
struct BuiltWith {
  std::vector<WatchedQuantity> watched;            ///< by the history
  std::vector<std::unique_ptr<port::Port>> ports;  ///< of the deck
  model::MemoryNeed need;                          ///< predicted
};

/// Fills the model with all that the deck lists but what does not act, and freezes it. Throws
/// InputError with all mistakes.
/// @param memory  what the model may need on a machine [B]
/// @param processes  that share it
BuiltWith build_model(const Catalogue& catalogue, const Options& deck,
                      const Imperfections& imperfections, const Setting& setting, const Log& log,
                      double memory, model::Processes processes, model::Model& model);

}  // namespace culm::simulation
